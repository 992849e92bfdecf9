#include "passes/lower_vrml1/shapes.h"

#include <cmath>

#include "base/text/bit_mask.h"
#include "scenegraph/nodes.h"

namespace wrlkit::vrml1 {
namespace {

namespace v1 = nodes::vrml1;

}  // namespace

const std::vector<NodeId>& Shapes::of(NodeId n, const State& s) {
  auto i = made_.find({n, s});
  return i != made_.end() ? i->second : made_.emplace(std::pair{n, s}, make(n, s)).first->second;
}

std::vector<NodeId> Shapes::make(NodeId n, const State& s) {
  std::vector<NodeId> out;
  if (scene_.is(n, v1::Cone))
    out = primitive(cone(n), s);
  else if (scene_.is(n, v1::Cylinder))
    out = primitive(cylinder(n), s);
  else if (scene_.is(n, v1::Sphere))
    out = primitive(sphere(n), s);
  else if (scene_.is(n, v1::Cube))
    out = cube(n, s);
  else if (scene_.is(n, v1::AsciiText) || scene_.is(n, v1::Text3))
    out = {shape(text(n, s), s, 0)};
  else if (scene_.is(n, v1::PointSet) || scene_.is(n, v1::MarkerSet) || scene_.is(n, v1::IndexedMarkerSet))
    out = points(n, s);
  else if (scene_.is(n, v1::Text2) || scene_.is(n, v1::NurbsCurve) || scene_.is(n, v1::NurbsSurface))
    diag_.report(Diag::no_vrml97_node, scene_.where(n), scene_.type(n).name);
  else if (scene_.is(n, nodes::X3DGeometryNode))
    out = {shape(n, s, 0)};
  else
    out = polygons(n, s);
  if (out.empty() || scene_.name(n).empty() || !scene_.is(n, nodes::Vrml1ShapeNode)) return out;
  if (out.size() > 1) {
    NodeId all = add(nodes::Group, n);
    scene_.set(all, nodes::group::children, out);
    out = {all};
  }
  scene_.set_name(out[0], scene_.name(n));
  return out;
}

NodeId Shapes::add(TypeId t, NodeId source) { return scene_.add(t, scene_.where(source)); }

NodeId Shapes::shape(NodeId geometry, const State& s, std::size_t material, bool colored, bool strokes, bool baked) {
  const NodeId look = looks_.appearance(s, material, colored, strokes, baked);
  NodeId n = add(nodes::Shape, geometry);
  scene_.set(n, nodes::shape::appearance, look, nodes::shape::geometry, geometry);
  return n;
}

// ---- primitives ----------------------------------------------------------------------------------------------------
// Sizes below zero occur in real files, and were drawn.

Shapes::Parts Shapes::cone(NodeId n) {
  const auto parts = scene_.get(n, v1::cone::parts);
  Parts out;
  for (auto [word, material] : {std::pair{"SIDES", 0}, {"BOTTOM", 1}}) {
    if (!has_bit(parts, word)) continue;
    NodeId g = add(nodes::Cone, n);
    scene_.set(g, nodes::cone::bottomRadius, std::abs(scene_.get(n, v1::cone::bottomRadius)), nodes::cone::height,
               scene_.get(n, v1::cone::height), nodes::cone::side, material == 0, nodes::cone::bottom, material == 1);
    out.emplace_back(g, material);
  }
  return out;
}

Shapes::Parts Shapes::cylinder(NodeId n) {
  const auto parts = scene_.get(n, v1::cylinder::parts);
  Parts out;
  for (auto [word, material] : {std::pair{"SIDES", 0}, {"TOP", 1}, {"BOTTOM", 2}}) {
    if (!has_bit(parts, word)) continue;
    NodeId g = add(nodes::Cylinder, n);
    scene_.set(g, nodes::cylinder::radius, std::abs(scene_.get(n, v1::cylinder::radius)), nodes::cylinder::height,
               std::abs(scene_.get(n, v1::cylinder::height)), nodes::cylinder::side, material == 0,
               nodes::cylinder::top, material == 1, nodes::cylinder::bottom, material == 2);
    out.emplace_back(g, material);
  }
  return out;
}

Shapes::Parts Shapes::sphere(NodeId n) {
  NodeId g = add(nodes::Sphere, n);
  scene_.set(g, nodes::sphere::radius, std::abs(scene_.get(n, v1::sphere::radius)));
  return {{g, 0}};
}

/// Parts of the same material are drawn by one node.
std::vector<NodeId> Shapes::primitive(const Parts& parts, const State& s) {
  if (s.drawing == Drawing::lines || s.drawing == Drawing::points)
    for (auto& [g, k] : parts) diag_.report(Diag::no_vrml97_value, scene_.where(g), "DrawStyle", "style");
  const auto n_materials = looks_.palette(s).size;
  const bool apart =
      (s.material_binding == Binding::per_part || s.material_binding == Binding::per_part_indexed) && n_materials > 1;
  std::vector<NodeId> out;
  Parts merged;
  for (auto [g, k] : parts) {
    const auto material = apart ? k % n_materials : 0;
    auto same = std::ranges::find(merged, material, &Parts::value_type::second);
    if (same == merged.end()) {
      merged.emplace_back(g, material);
      continue;
    }
    for (auto slot : scene_.is(g, nodes::Cone) ? std::vector{nodes::cone::side.slot, nodes::cone::bottom.slot}
                                               : std::vector{nodes::cylinder::side.slot, nodes::cylinder::top.slot,
                                                             nodes::cylinder::bottom.slot})
      if (scene_.value(g, slot).integer) scene_.set(same->first, scene_.make(FieldType::SFBool, slot, true));
  }
  for (auto [g, material] : merged) out.push_back(shape(g, s, material));
  return out;
}

// Front, back, left, right, top, bottom, with the texture upright on each as on a Box. VRML97 has no flat Box.
std::vector<NodeId> Shapes::cube(NodeId n, const State& s) {
  const Vec3 size{std::abs(scene_.get(n, v1::cube::width)), std::abs(scene_.get(n, v1::cube::height)),
                  std::abs(scene_.get(n, v1::cube::depth))};
  const bool apart = of_faces(s.material_binding) && looks_.palette(s).size > 1,
             flat = size[0] * size[1] * size[2] == 0;
  if (!apart && !flat && s.drawing != Drawing::lines && s.drawing != Drawing::points) {
    NodeId g = add(nodes::Box, n);
    scene_.set(g, nodes::box::size, size);
    return {shape(g, s, 0)};
  }
  std::vector<double> corners;
  for (int k = 0; k < 8; ++k)
    for (int axis = 0; axis < 3; ++axis)
      corners.push_back((k >> axis & 1 ? 0.5 : -0.5) * size[static_cast<std::size_t>(axis)]);
  constexpr std::int32_t sides[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {0, 4, 6, 2},
                                        {5, 1, 3, 7}, {6, 7, 3, 2}, {0, 1, 5, 4}};
  Faces f;
  Job job{n, s, 8, {}, {}, {}, {}};
  job.texture.of = Attribute::Of::corners;
  for (std::int32_t k = 0; k < 6; ++k) {
    f.faces.push_back({static_cast<std::uint32_t>(f.coord.size()), 4, k, k});
    for (std::int32_t c = 0; c < 4; ++c) {
      f.coord.push_back(sides[k][c]);
      job.texture.index.push_back(c);
    }
    f.coord.push_back(-1);
    job.texture.index.push_back(-1);
  }
  f.sequence = f.place = f.coord;
  NodeId coord = job.state.coord = add(v1::Coordinate3, n), texture = add(nodes::TextureCoordinate, n),
         hints = job.state.hints = add(v1::ShapeHints, n);
  scene_.set(coord, v1::coordinate3::point, corners);
  scene_.set(texture, nodes::texture_coordinate::point, std::vector<double>{0, 0, 1, 0, 1, 1, 0, 1});
  scene_.set(hints, v1::shape_hints::vertexOrdering, "COUNTERCLOCKWISE", v1::shape_hints::shapeType, "SOLID",
             v1::shape_hints::creaseAngle, 0.0);
  job.texture_coord = texture;
  if (apart)
    job.colors = bind(f, s.material_binding, {}, looks_.palette(s).size);
  else
    job.colors.of = Attribute::Of::all;
  return emit_all(job, f);
}

NodeId Shapes::text(NodeId n, const State& s) {
  const bool solid = scene_.is(n, v1::Text3);
  NodeId g = add(nodes::Text, n);
  scene_.set(g, nodes::text::string, solid ? scene_.get(n, v1::text3::string) : scene_.get(n, v1::ascii_text::string));
  if (solid) {
    auto parts = scene_.get(n, v1::text3::parts);
    if (has_bit(parts, "SIDES") || has_bit(parts, "BACK"))
      diag_.report(Diag::no_vrml97_value, scene_.where(n), "Text3", "parts");
  } else if (auto width = scene_.get(n, v1::ascii_text::width);
             std::ranges::any_of(width, [](double w) { return w > 0; }))
    scene_.set(g, nodes::text::length, width);
  scene_.set(g, nodes::text::fontStyle, font_style(s.font, n));
  return g;
}

NodeId Shapes::font_style(NodeId font, NodeId text) {
  const bool solid = scene_.is(text, v1::Text3);
  const auto justification =
      solid ? scene_.get(text, v1::text3::justification) : scene_.get(text, v1::ascii_text::justification);
  const double spacing = solid ? scene_.get(text, v1::text3::spacing) : scene_.get(text, v1::ascii_text::spacing);
  auto& n = font_styles_[{font, justification, spacing}];
  if (n) return n;
  n = add(nodes::FontStyle, font ? font : text);
  double size = 10;
  std::string_view family = "SERIF";
  bool bold = false, italic = false;
  if (font && scene_.is(font, v1::Font)) {  // "Helvetica-BoldOblique"
    auto name = scene_.get(font, v1::font::name);
    auto has = [&](std::string_view w) { return name.find(w) != name.npos; };
    size = scene_.get(font, v1::font::size);
    if (has("Helvetica") || has("Arial") || has("Sans")) family = "SANS";
    if (has("Courier") || has("Mono") || has("Typewriter")) family = "TYPEWRITER";
    bold = has("Bold");
    italic = has("Italic") || has("Oblique");
  } else if (font) {
    size = scene_.get(font, v1::font_style::size);
    if (auto f = scene_.get(font, v1::font_style::family); f == "SANS" || f == "TYPEWRITER") family = f;
    for_each_bit(scene_.get(font, v1::font_style::style), [&](std::string_view w) {
      bold |= w == "BOLD";
      italic |= w == "ITALIC";
    });
  }
  if (font) scene_.set_name(n, scene_.name(font));
  scene_.set(n, nodes::font_style::size, size, nodes::font_style::family, std::vector<std::string_view>{family},
             nodes::font_style::style,
             bold && italic ? "BOLDITALIC"
             : bold         ? "BOLD"
             : italic       ? "ITALIC"
                            : "PLAIN");
  scene_.set(n, nodes::font_style::justify,
             std::vector<std::string_view>{justification == "RIGHT"    ? "END"
                                           : justification == "CENTER" ? "MIDDLE"
                                                                       : "BEGIN"});
  scene_.set(n, nodes::font_style::spacing, spacing);
  return n;
}

}  // namespace wrlkit::vrml1
