// Shapes made of the current coordinates: polygons, lines and points.
#include <limits>
#include <map>
#include <numeric>

#include "passes/lower_vrml1/shapes.h"
#include "scenegraph/nodes.h"

namespace wrlkit::vrml1 {
namespace {

namespace v1 = nodes::vrml1;
using Of = Attribute::Of;
constexpr std::size_t unlimited = std::numeric_limits<std::int32_t>::max();  // values that do not begin again

/// A field that several types have, by its name.
const Value* named_field(const Scene& scene, NodeId n, std::string_view field) {
  auto slot = scene.type(n).find(field, Dialect::vrml1);
  return slot ? &scene.value(n, *slot) : nullptr;
}

std::span<const std::int32_t> index_field(const Scene& scene, NodeId n, std::string_view field) {
  const Value* v = named_field(scene, n, field);
  return v ? v->integer_span() : std::span<const std::int32_t>{};
}

bool is_line(const Scene& scene, NodeId n) { return scene.is(n, v1::IndexedLineSet) || scene.is(n, v1::LineSet); }
bool has_index(const Scene& scene, NodeId n) { return named_field(scene, n, "coordIndex") != nullptr; }

}  // namespace

// ---- what the state gives ------------------------------------------------------------------------------------------

void Shapes::apply_vertex_property(NodeId geometry, State& s) const {
  namespace f = v1::vertex_property;
  const Value* v = named_field(scene_, geometry, "vertexProperty");
  const NodeId p = v ? v->node : NodeId{};
  if (!p || !scene_.is(p, v1::VertexProperty)) return;
  if (!scene_.get(p, f::vertex).empty()) s.coord = p;
  if (!scene_.get(p, f::normal).empty()) {
    s.normal = p;
    s.normal_binding = read_binding(scene_.get(p, f::normalBinding));
  }
  if (!scene_.get(p, f::texCoord).empty()) {
    s.texture_coord = p;
    s.texture_binding = read_binding(scene_.get(p, f::textureCoordBinding));
  }
  if (!scene_.get(p, f::orderedRGBA).empty()) {
    s.color = p;
    s.material_binding = read_binding(scene_.get(p, f::materialBinding));
  }
}

std::vector<double> Shapes::positions(NodeId n) const {
  std::span<const double> p;
  if (scene_.is(n, v1::Coordinate3))
    p = scene_.get(n, v1::coordinate3::point);
  else if (scene_.is(n, v1::VertexProperty))
    p = scene_.get(n, v1::vertex_property::vertex);
  if (!scene_.is(n, v1::Coordinate4)) return {p.begin(), p.end()};
  auto weighted = scene_.get(n, v1::coordinate4::point);
  std::vector<double> out;
  for (std::size_t i = 0; i + 3 < weighted.size(); i += 4)
    for (std::size_t k = 0; k < 3; ++k)
      out.push_back(weighted[i + 3] != 0 ? weighted[i + k] / weighted[i + 3] : weighted[i + k]);
  return out;
}

std::size_t Shapes::n_positions(NodeId n) const {
  if (scene_.is(n, v1::Coordinate3)) return scene_.get(n, v1::coordinate3::point).size() / 3;
  if (scene_.is(n, v1::VertexProperty)) return scene_.get(n, v1::vertex_property::vertex).size() / 3;
  return n ? scene_.get(n, v1::coordinate4::point).size() / 4 : 0;
}

NodeId Shapes::coordinate(NodeId source) {
  auto& n = coordinates_[source];
  if (n) return n;
  n = add(nodes::Coordinate, source);
  scene_.set_name(n, scene_.name(source));
  if (scene_.is(source, v1::Coordinate4)) {
    scene_.set(n, nodes::coordinate::point, positions(source));
    return n;
  }
  // The array itself is shared.
  Value v = scene_.value(
      source, scene_.is(source, v1::Coordinate3) ? v1::coordinate3::point.slot : v1::vertex_property::vertex.slot);
  v.slot = nodes::coordinate::point.slot;
  scene_.set(n, v);
  return n;
}

NodeId Shapes::normal(NodeId source) {
  auto& n = normals_[source];
  if (n) return n;
  n = add(nodes::Normal, source);
  scene_.set_name(n, scene_.name(source));
  Value v =
      scene_.value(source, scene_.is(source, v1::Normal) ? v1::normal::vector.slot : v1::vertex_property::normal.slot);
  v.slot = nodes::normal::vector.slot;
  scene_.set(n, v);
  return n;
}

NodeId Shapes::texture_coordinate(NodeId source, std::uint32_t map) {
  auto& n = texture_coordinates_[{source, map}];
  if (n) return n;
  n = add(nodes::TextureCoordinate, source);
  scene_.set_name(n, scene_.name(source));
  Value v = scene_.value(source, scene_.is(source, v1::TextureCoordinate2) ? v1::texture_coordinate2::point.slot
                                                                           : v1::vertex_property::texCoord.slot);
  v.slot = nodes::texture_coordinate::point.slot;
  if (map == 0) {
    scene_.set(n, v);
    return n;
  }
  std::vector<double> moved;
  for (auto uv = v.number_span(); uv.size() >= 2; uv = uv.subspan(2)) {
    auto p = looks_.uv_map(map)(uv[0], uv[1]);
    moved.insert(moved.end(), p.begin(), p.end());
  }
  scene_.set(n, nodes::texture_coordinate::point, moved);
  return n;
}

/// Texture coordinates by projection: a length of the direction is once across the picture.
NodeId Shapes::projected(NodeId plane, NodeId coord) {
  const Vec3 directions[] = {scene_.get(plane, v1::texture_coordinate_plane::directionS),
                             scene_.get(plane, v1::texture_coordinate_plane::directionT)};
  const auto points = positions(coord);
  std::vector<double> uv;
  for (std::size_t i = 0; i < points.size(); i += 3)
    for (auto& d : directions) {
      const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
      uv.push_back(square > 0 ? (points[i] * d[0] + points[i + 1] * d[1] + points[i + 2] * d[2]) / square : 0);
    }
  NodeId n = add(nodes::TextureCoordinate, plane);
  scene_.set(n, nodes::texture_coordinate::point, uv);
  return n;
}

// ---- polygons and lines --------------------------------------------------------------------------------------------

std::vector<NodeId> Shapes::polygons(NodeId n, State s) {
  apply_vertex_property(n, s);
  Job job{n, s, n_positions(s.coord), {}, {}, {}, {}};
  job.lines = is_line(scene_, n);
  if (job.n_points == 0) {
    diag_.report(Diag::degenerate_geometry, scene_.where(n), scene_.type(n).name, "there are no coordinates");
    return std::vector<NodeId>{};
  }
  const bool by_part = s.material_binding == Binding::per_part || s.material_binding == Binding::per_part_indexed;
  const Faces f = read_faces(scene_, n, job.n_points, job.lines && by_part);
  if (f.faces.empty()) return {};
  bind_all(job, f);
  return emit_all(job, f);
}

void Shapes::bind_all(Job& job, const Faces& f) {
  auto& s = job.state;
  job.colors = bind(f, s.material_binding, index_field(scene_, job.source, "materialIndex"), looks_.palette(s).size);
  if (looks_.palette(s).size == 1) job.colors = {Of::all, {}};
  if (s.normal && !job.lines) {
    const auto automatic = has_index(scene_, job.source) ? Binding::per_vertex_indexed : Binding::per_vertex;
    job.normals = bind(f, s.normal_binding == Binding::automatic ? automatic : s.normal_binding,
                       index_field(scene_, job.source, "normalIndex"), unlimited);
    const auto count = scene_.is(s.normal, v1::Normal) ? scene_.get(s.normal, v1::normal::vector).size() / 3
                                                       : scene_.get(s.normal, v1::vertex_property::normal).size() / 3;
    if (values_needed(f, job.normals) > count) job.normals = {};  // too few of them: they are made
  }
  if (!job.lines) bind_texture(job, f);
}

// Without a texture the coordinates of an earlier shape mean nothing.
void Shapes::bind_texture(Job& job, const Faces& f) {
  auto& s = job.state;
  const auto index = index_field(scene_, job.source, "textureCoordIndex");
  if (!s.texture_coord || (!looks_.has_texture(s.texture) && index.size() <= 1)) return;
  if (scene_.is(s.texture_coord, v1::TextureCoordinateEnvironment))
    return diag_.report(Diag::no_vrml97_node, scene_.where(s.texture_coord), scene_.type(s.texture_coord).name);
  if (scene_.is(s.texture_coord, v1::TextureCoordinatePlane)) {
    job.texture.of = Of::corners;
    job.texture_coord = projected(s.texture_coord, s.coord);
    return;
  }
  const bool by_vertex = s.texture_binding == Binding::per_vertex ||
                         (s.texture_binding == Binding::automatic && !has_index(scene_, job.source));
  job.texture = bind(f, by_vertex ? Binding::per_vertex : Binding::per_vertex_indexed, index, unlimited);
  const auto count = scene_.is(s.texture_coord, v1::TextureCoordinate2)
                         ? scene_.get(s.texture_coord, v1::texture_coordinate2::point).size() / 2
                         : scene_.get(s.texture_coord, v1::vertex_property::texCoord).size() / 2;
  if (values_needed(f, job.texture) > count) {
    job.texture = {};
    return;
  }
  job.baked = !looks_.can_say(s.texture_transform);
  job.texture_coord = texture_coordinate(s.texture_coord, job.baked ? s.texture_transform : 0);
}

// One Shape for each kind of material; materials of one kind differ in colour only.
std::vector<NodeId> Shapes::emit_all(const Job& job, const Faces& f) {
  const auto& palette = looks_.palette(job.state);
  const NodeId coord = coordinate(job.state.coord);
  auto material_of = [&](std::size_t face) {
    return job.colors.index.empty() ? face : static_cast<std::size_t>(job.colors.index[face]);
  };
  if (job.colors.of == Of::corners && !palette.kind.empty())
    diag_.report(Diag::no_vrml97_vertex_material, scene_.where(job.source), scene_.type(job.source).name);
  std::map<std::size_t, std::vector<std::uint32_t>> kinds;
  if (job.colors.of == Of::faces && !palette.kind.empty())
    for (std::uint32_t k = 0; k < f.faces.size(); ++k) kinds[palette.kind_of(material_of(k))].push_back(k);
  if (kinds.size() <= 1)
    return {emit(job, f, job.colors, job.normals, job.texture, kinds.empty() ? 0 : kinds.begin()->first, coord)};
  std::vector<NodeId> out;
  for (auto& [kind, which] : kinds)
    out.push_back(emit(job, choose(f, which), choose(f, which, job.colors), choose(f, which, job.normals),
                       choose(f, which, job.texture), kind, coord));
  return out;
}

NodeId Shapes::emit(const Job& job, const Faces& f, const Attribute& colors, const Attribute& normals,
                    const Attribute& texture, std::size_t material, NodeId coord) {
  const auto& palette = looks_.palette(job.state);
  // Faces of one colour need no colours.
  bool colored = colors.of == Of::faces || colors.of == Of::corners;
  if (colors.of == Of::faces && !colors.index.empty()) {
    const Vec3 first = palette.color(static_cast<std::size_t>(colors.index[0]));
    if (std::ranges::all_of(colors.index,
                            [&](std::int32_t i) { return palette.color(static_cast<std::size_t>(i)) == first; })) {
      colored = false;
      material = static_cast<std::size_t>(colors.index[0]);
    }
  }
  const bool strokes = job.lines || job.state.drawing == Drawing::lines || job.state.drawing == Drawing::points;
  NodeId g;
  if (job.state.drawing == Drawing::points) {
    g = add(nodes::PointSet, job.source);
    if (colored) {
      diag_.report(Diag::no_vrml97_value, scene_.where(job.source), "DrawStyle", "style");
      colored = false;
    }
  } else
    g = strokes ? line_set(job, f) : face_set(job, f, normals, texture);
  scene_.set(g, scene_.make(FieldType::SFNode, *scene_.type(g).find("coord", Dialect::vrml97), coord));
  if (colored) set_colors(g, job, f, colors);
  return shape(g, job.state, material, colored, strokes, job.baked);
}

NodeId Shapes::face_set(const Job& job, const Faces& f, const Attribute& normals, const Attribute& texture) {
  namespace g = nodes::indexed_face_set;
  NodeId n = add(nodes::IndexedFaceSet, job.source);
  if (f.verbatim) {
    Value v = scene_.value(job.source, v1::indexed_face_set::coordIndex.slot);
    v.slot = g::coordIndex.slot;
    scene_.set(n, v);
  } else
    scene_.set(n, g::coordIndex, f.coord);
  if (normals) {
    scene_.set(n, g::normal, normal(job.state.normal), g::normalPerVertex, normals.of == Of::corners);
    if (normals.of == Of::all)
      scene_.set(n, g::normalIndex, std::vector<std::int32_t>(f.faces.size(), 0));
    else if (!normals.index.empty())
      scene_.set(n, g::normalIndex, normals.index);
  }
  if (texture) {
    scene_.set(n, g::texCoord, job.texture_coord);
    if (!texture.index.empty()) scene_.set(n, g::texCoordIndex, texture.index);
  }
  const NodeId hints = job.state.hints;
  auto ordering = hints ? scene_.get(hints, v1::shape_hints::vertexOrdering) : "UNKNOWN_ORDERING";
  scene_.set(n, g::ccw, ordering != "CLOCKWISE");
  scene_.set(n, g::solid,
             hints && ordering != "UNKNOWN_ORDERING" && scene_.get(hints, v1::shape_hints::shapeType) == "SOLID");
  scene_.set(n, g::convex, !hints || scene_.get(hints, v1::shape_hints::faceType) == "CONVEX");
  const bool says_angle = hints && scene_.find(hints, v1::shape_hints::creaseAngle.slot);
  scene_.set(n, g::creaseAngle, says_angle ? scene_.get(hints, v1::shape_hints::creaseAngle) : crease_angle_);
  return n;
}

/// Polylines, or the edges of faces, which are closed.
NodeId Shapes::line_set(const Job& job, const Faces& f) {
  NodeId n = add(nodes::IndexedLineSet, job.source);
  if (job.lines) {
    scene_.set(n, nodes::indexed_line_set::coordIndex, f.coord);
    return n;
  }
  std::vector<std::int32_t> closed;
  for (auto& face : f.faces) {
    closed.insert(closed.end(), f.coord.begin() + face.begin, f.coord.begin() + face.begin + face.count);
    closed.push_back(f.coord[face.begin]);
    closed.push_back(-1);
  }
  scene_.set(n, nodes::indexed_line_set::coordIndex, closed);
  return n;
}

void Shapes::set_colors(NodeId n, const Job& job, const Faces& f, const Attribute& colors) {
  const bool lines = scene_.is(n, nodes::IndexedLineSet);
  scene_.set(n, lines ? nodes::indexed_line_set::color : nodes::indexed_face_set::color, looks_.color_node(job.state));
  scene_.set(n, lines ? nodes::indexed_line_set::colorPerVertex : nodes::indexed_face_set::colorPerVertex,
             colors.of == Of::corners);
  auto index = colors.index;
  if (lines && !job.lines && colors.of == Of::corners && !index.empty()) {
    std::vector<std::int32_t> closed;
    for (auto& face : f.faces) {
      closed.insert(closed.end(), index.begin() + face.begin, index.begin() + face.begin + face.count);
      closed.push_back(index[face.begin]);
      closed.push_back(-1);
    }
    index = closed;
  }
  if (!index.empty())
    scene_.set(n, lines ? nodes::indexed_line_set::colorIndex : nodes::indexed_face_set::colorIndex, index);
}

// ---- points --------------------------------------------------------------------------------------------------------

std::vector<NodeId> Shapes::points(NodeId n, State s) {
  apply_vertex_property(n, s);
  const auto n_points = n_positions(s.coord);
  const auto& palette = looks_.palette(s);
  std::vector<std::size_t> which;
  if (has_index(scene_, n)) {
    for (auto i : index_field(scene_, n, "coordIndex"))
      if (i >= 0 && static_cast<std::size_t>(i) < n_points) which.push_back(static_cast<std::size_t>(i));
  } else {
    const auto start = static_cast<std::size_t>(std::max(0, index_field(scene_, n, "startIndex")[0])),
               most = n_points > start ? n_points - start : 0;
    const auto asked = index_field(scene_, n, "numPoints")[0];
    which.resize(asked < 0 ? most : std::min(most, static_cast<std::size_t>(asked)));
    std::iota(which.begin(), which.end(), start);
  }
  if (which.empty()) return {};
  NodeId g = add(nodes::PointSet, n);
  const bool all = which.size() == n_points && which[0] == 0 && !has_index(scene_, n);
  NodeId coord = all ? coordinate(s.coord) : add(nodes::Coordinate, s.coord);
  if (!all) {
    const auto points = positions(s.coord);
    std::vector<double> chosen;
    for (auto i : which)
      chosen.insert(chosen.end(), points.begin() + static_cast<std::ptrdiff_t>(3 * i),
                    points.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
    scene_.set(coord, nodes::coordinate::point, chosen);
  }
  scene_.set(g, nodes::point_set::coord, coord);
  const bool colored = palette.size > 1 && s.material_binding > Binding::overall;
  if (colored) {
    const auto index = index_field(scene_, n, "materialIndex");
    std::vector<double> colors;
    for (std::size_t k = 0; k < which.size(); ++k) {
      const bool looked_up = s.material_binding == Binding::per_vertex_indexed && k < index.size() && index[k] >= 0;
      const auto c = palette.color(looked_up ? static_cast<std::size_t>(index[k])
                                   : s.material_binding == Binding::per_vertex_indexed ? which[k]
                                                                                       : k);
      colors.insert(colors.end(), c.begin(), c.end());
    }
    NodeId color = add(nodes::Color, n);
    scene_.set(color, nodes::color::color, colors);
    scene_.set(g, nodes::point_set::color, color);
  }
  return {shape(g, s, 0, colored, true)};
}

}  // namespace wrlkit::vrml1
