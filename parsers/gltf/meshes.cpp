#include "parsers/gltf/meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/forms/form_node.h"
#include "parsers/gltf/features.h"
#include "parsers/gltf/polygons.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

/// RGB of RGBA; was any of it transparent?
bool without_alpha(std::vector<double>& v) {
  std::size_t to = 0;
  bool clear = false;
  for (std::size_t i = 0; i + 3 < v.size(); i += 4) {
    clear |= v[i + 3] < 1;
    v[to++] = v[i];
    v[to++] = v[i + 1];
    v[to++] = v[i + 2];
  }
  v.resize(to);
  return clear;
}

/// To colours as they are displayed, of three or four numbers each; alpha stays.
void to_display(std::vector<double>& colors, std::size_t width) {
  for (std::size_t i = 0; i < colors.size(); ++i)
    if (i % width < 3) colors[i] = display(static_cast<float>(colors[i]));
}

/// VRML counts places in pictures from the bottom.
double from_top(double t) { return std::round((1 - t) * 1e9) / 1e9; }

bool is_identity_factor(const Vec3& f) { return f == Vec3{1, 1, 1}; }

}  // namespace

std::vector<Meshes::Part> Meshes::parts(std::uint32_t index, const Pose& pose) {
  std::vector<Part> out;
  reader_.morphs().clear();
  reader_.unpacked_ids().clear();
  const Json mesh = c_.file.at(Table::meshes, index);
  std::uint32_t k = 0;
  for (Json json : mesh["primitives"].elements()) {
    Primitive p{json, mesh, c_.file.index(Table::materials, json["material"]),
                static_cast<int>(json["mode"] ? std::min<std::uint64_t>(json["mode"].whole().value_or(99), 99) : 4)};
    if (p.mode > 6) {
      c_.diag().report(Diag::gltf_bad_value, c_.file.where(json), "mode");
      continue;
    }
    auto make = [&](std::vector<Part>& to) {
      auto made = part(p, pose);
      if (!made) return;
      auto apart = features(p, *made);
      if (apart.empty()) apart.push_back(*made);
      to.insert(to.end(), apart.begin(), apart.end());
    };
    if (!pose.shared()) {
      make(out);
    } else {
      auto [i, is_new] = parts_.try_emplace({index, k});
      if (is_new) make(i->second);
      out.insert(out.end(), i->second.begin(), i->second.end());
    }
    ++k;
  }
  return out;
}

std::optional<Meshes::Part> Meshes::part(const Primitive& p, const Pose& how) {
  const bool is_whole = c_.file.is_whole();
  const Json attributes = p.json["attributes"];
  Sets sets{"TEXCOORD_" + std::to_string(is_whole ? 0 : materials_.texcoord_set(p.material).value_or(0)), {}};
  if (const auto light = materials_.light_set(p.material); light && p.faces())
    sets.light = "TEXCOORD_" + std::to_string(*light);
  const Json kept = vrml97(p.mesh);
  SurfaceKind kind{p.faces(), bool(attributes["COLOR_0"]) || (is_whole && attributes["_COLOR"]),
                   bool(attributes[sets.texcoord]), !sets.light.empty() && attributes[sets.light]};
  const bool hides_colors = kind.light && materials_.is_light(p.material);
  if (hides_colors) kind.color = false;
  if (is_whole) kind.given_texcoord = bool(kept["IndexedFaceSet"]["texCoord"]);
  const Look& look = materials_.get(p.material, kind);
  NodeId geometry;
  if (is_whole) {
    std::string key = look.double_sided ? "2" : "1";
    for (Json part : {attributes, p.json["indices"], p.json["mode"], p.mesh["name"], p.mesh["extras"]})
      (key += ' ') += part.source();
    NodeId& known = own_[key];
    if (known && how.shared()) return Part{look.appearance, known};
    if (NodeId whole = kept_whole(p)) return Part{look.appearance, known = whole};
    Streams s;
    if (!reader_.load(p, how, sets, s)) return std::nullopt;
    if (hides_colors) s.color = {};
    geometry = own(p, s, look);
    if (how.shared()) known = geometry;
  } else {
    Streams s;
    if (!reader_.load(p, how, sets, s)) return std::nullopt;
    if (hides_colors) s.color = {};
    geometry = foreign(p, s, look);
    if (!geometry) return std::nullopt;
    if (c_.file.is_own()) name_attributes(geometry, kept);
    if (c_.file.is_own()) extras_.tags(geometry, kept[c_.scene.type(geometry).name]);
    if (!c_.file.is_own()) report_lost(p, sets);
  }
  if (p.mesh["primitives"].elements().size() == 1) c_.set_name(geometry, p.mesh["name"]);
  extras_.define(geometry);
  auto& morphs = reader_.morphs();
  if (!morphs.empty() && !morphs.back().coordinate) {
    auto coord = p.faces()               ? nodes::indexed_face_set::coord.slot
                 : p.mode == points_mode ? nodes::point_set::coord.slot
                                         : nodes::indexed_line_set::coord.slot;
    morphs.back().coordinate = c_.scene.value(geometry, coord).node;
  }
  return Part{look.appearance, geometry};
}

bool Meshes::has_features(std::uint32_t mesh) const {
  if (!c_.file.is_own()) return false;
  for (Json p : c_.file.at(Table::meshes, mesh)["primitives"].elements())
    if (p["extensions"]["EXT_mesh_features"]) return true;
  return false;
}

std::vector<Meshes::Part> Meshes::features(const Primitive& p, const Part& whole) {
  std::vector<Part> out;
  const Json set = p.json["extensions"]["EXT_mesh_features"];
  const auto first = first_vertex_.find(whole.geometry.value);
  if (!c_.file.is_own() || !set || first == first_vertex_.end()) return out;
  const auto sets = set["featureIds"].elements();
  const Json ids_of = sets.empty() ? Json() : sets[0];
  const bool packed = bool(p.json["extensions"]["KHR_draco_mesh_compression"]);
  const auto ids =
      packed ? rows_.ids(ids_of, std::exchange(reader_.unpacked_ids(), {})) : rows_.ids(ids_of, p.json["attributes"]);
  if (ids.empty()) return out;
  std::vector<std::uint32_t> of_face;
  for (auto v : first->second) of_face.push_back(v < ids.size() ? ids[v] : none);
  for (auto [row, geometry] : take_apart(c_.scene, whole.geometry, of_face))
    out.push_back({whole.appearance, geometry, row});
  return out;
}

/// Forms with fields of our own.
NodeId Meshes::recognised(const Primitive& p) {
  const Json kept = p.mesh["extras"]["wrlkit"];
  for (Json e : kept.is_object() ? kept : Json()) {
    const TypeId own = find_builtin(e.key(), Dialect::wrlkit), t = own ? own : find_builtin(e.key(), Dialect::vrml97);
    if (!t || !builtin_nodes()[t.value].is_a(nodes::X3DGeometryNode)) continue;
    NodeId n = c_.add(t, e);
    extras_.fields(n, e);
    if (!read_form(c_.scene, n)) continue;
    c_.set_name(n, p.mesh["name"]);
    extras_.define(n);
    return n;
  }
  return {};
}

/// Forms whose fields are all in extras; the mesh is what they look like.
NodeId Meshes::kept_whole(const Primitive& p) {
  if (NodeId form = recognised(p)) return form;
  const Json kept = vrml97(p.mesh);
  for (Json e : kept.is_object() ? kept : Json()) {
    const TypeId t = find_builtin(e.key(), Dialect::vrml97);
    if (!t || !builtin_nodes()[t.value].is_a(nodes::X3DGeometryNode)) continue;
    const bool partly = t == nodes::IndexedFaceSet   ? !e["coordIndex"]
                        : t == nodes::IndexedLineSet ? !e["coordIndex"]
                                                     : t == nodes::PointSet && !e["coord"]["Coordinate"]["point"];
    if (partly) continue;
    NodeId n = c_.add(t, e);
    extras_.fields(n, e);
    c_.set_name(n, p.mesh["name"]);
    extras_.define(n);
    return n;
  }
  return {};
}

NodeId Meshes::attribute(TypeId type, std::uint16_t slot, FieldType field, Stream& s, int variant, bool loose,
                         const std::function<void(std::vector<double>&)>& change) {
  NodeId unshared;
  NodeId& known = loose ? unshared : attributes_[{type.value, s.accessor, variant}];
  if (known) return known;
  const auto widths = type == nodes::TextureCoordinate                   ? two
                      : type == nodes::Color || type == nodes::ColorRGBA ? color_widths
                                                                         : three;
  auto values = s.values;
  if (values.empty()) {
    auto read = c_.accessors.numbers(s.accessor, widths);
    if (!read) return {};
    s.width = read->width;
    values = std::move(read->values);
  }
  change(values);
  known = c_.add(type, c_.file.at(Table::accessors, s.accessor));
  c_.scene.set(known, c_.scene.make(field, slot, values));
  return known;
}

NodeId Meshes::color_of(const Primitive& p, Streams& s, const Look& look, int variant) {
  const bool has_alpha = s.color.width == 4 || c_.file.at(Table::accessors, s.color.accessor)["type"].text() == "VEC4";
  if (has_alpha && c_.file.at(Table::materials, p.material)["alphaMode"].text() == "BLEND")
    return attribute(nodes::ColorRGBA, nodes::color_rgba::color.slot, FieldType::MFColorRGBA, s.color, variant, s.loose,
                     [&](std::vector<double>& v) {
                       for (std::size_t i = 0; i < v.size(); ++i)
                         if (i % 4 < 3) v[i] *= look.color_factor[i % 4];
                       to_display(v, 4);
                     });
  auto change = [&](std::vector<double>& v) {
    if (s.color.width == 4 && without_alpha(v)) c_.lost.add("alpha of COLOR_0", c_.file.where(p.json));
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = display(static_cast<float>(v[i] * look.color_factor[i % 3]));
  };
  return attribute(nodes::Color, nodes::color::color.slot, FieldType::MFColor, s.color, variant, s.loose, change);
}

NodeId Meshes::texcoord_of(Streams& s, const Look& look, int variant) {
  auto change = [&](std::vector<double>& v) {
    const auto a = look.bake.value_or(TexcoordMap{});
    for (std::size_t i = 0; i + 1 < v.size(); i += 2) {
      const double u = v[i], t = from_top(v[i + 1]);
      v[i] = look.bake ? a.xx * u + a.xy * t + a.x : u;
      v[i + 1] = look.bake ? a.yx * u + a.yy * t + a.y : t;
    }
  };
  return attribute(nodes::TextureCoordinate, nodes::texture_coordinate::point.slot, FieldType::MFVec2f, s.texcoord,
                   variant, s.loose, change);
}

Meshes::Attributes Meshes::attributes_of(const Primitive& p, Streams& s, const Look& look) {
  const auto nothing = [](std::vector<double>&) {};
  Attributes a;
  const int variant = is_identity_factor(look.color_factor) && !look.bake ? 0 : static_cast<int>(p.material) + 1;
  a.coord =
      attribute(nodes::Coordinate, nodes::coordinate::point.slot, FieldType::MFVec3f, s.position, 0, s.loose, nothing);
  if (!a.coord) return a;
  if (s.normal && p.faces())
    a.normal = attribute(nodes::Normal, nodes::normal::vector.slot, FieldType::MFVec3f, s.normal, 0, s.loose, nothing);
  if (s.color) a.color = color_of(p, s, look, variant);
  if (s.texcoord && p.faces() && look.textured) a.texcoord = texcoord_of(s, look, variant);
  if (s.light)
    a.light = attribute(nodes::TextureCoordinate, nodes::texture_coordinate::point.slot, FieldType::MFVec2f, s.light,
                        -1, s.loose, [](std::vector<double>& v) {
                          for (std::size_t i = 1; i < v.size(); i += 2) v[i] = from_top(v[i]);
                        });
  return a;
}

/// A PointSet has no indices.
NodeId Meshes::foreign_points(const Primitive& p, const Streams& s, Attributes a,
                              std::span<const std::uint32_t> corners) {
  Scene& scene = c_.scene;
  NodeId n = c_.add(nodes::PointSet, p.json);
  note_first_vertices(n, p, {corners.begin(), corners.end()});
  auto gather = [&](NodeId from, std::uint16_t slot, TypeId type) {
    auto all = scene.value(from, slot).number_span();
    std::vector<double> some;
    for (auto v : corners) some.insert(some.end(), all.begin() + 3 * v, all.begin() + 3 * v + 3);
    NodeId to = c_.add(type, p.json);
    scene.set(to, scene.make(type == nodes::Color ? FieldType::MFColor : FieldType::MFVec3f, slot, some));
    return to;
  };
  if (s.indexed) a.coord = gather(a.coord, nodes::coordinate::point.slot, nodes::Coordinate);
  if (s.indexed && a.color) a.color = gather(a.color, nodes::color::color.slot, nodes::Color);
  scene.set(n, nodes::point_set::coord, a.coord);
  if (a.color) scene.set(n, nodes::point_set::color, a.color);
  return n;
}

NodeId Meshes::foreign(const Primitive& p, Streams& s, const Look& look) {
  namespace faces = nodes::indexed_face_set;
  namespace lines = nodes::indexed_line_set;
  const Attributes a = attributes_of(p, s, look);
  if (!a.coord) return {};
  const auto corners = reader_.elements(p, s);
  if (p.mode == points_mode) return foreign_points(p, s, a, corners);
  Scene& scene = c_.scene;
  NodeId n = c_.add(p.faces() ? nodes::IndexedFaceSet : nodes::IndexedLineSet, p.json);
  note_first_vertices(n, p, corners);
  Value index = scene.make(FieldType::MFInt32, 0, p.faces() ? faces_of(corners) : polylines_of(corners));
  if (!s.loose) index = coord_index_.try_emplace({p.mode, s.index_accessor, s.n}, index).first->second;
  index.slot = p.faces() ? faces::coordIndex.slot : lines::coordIndex.slot;
  auto set = [&](std::uint16_t slot, NodeId value) {
    if (value) scene.set(n, scene.make(FieldType::SFNode, slot, value));
  };
  set(p.faces() ? faces::coord.slot : lines::coord.slot, a.coord);
  if (p.faces()) set(faces::normal.slot, a.normal);
  set(p.faces() ? faces::color.slot : lines::color.slot, a.color);
  if (p.faces()) {
    set(faces::texCoord.slot, a.texcoord);
    set(faces::lightCoord.slot, a.light);
    if (look.double_sided) scene.set(n, faces::solid, false);
  }
  scene.set(n, index);
  return n;
}

void Meshes::report_lost(const Primitive& p, const Sets& sets) {
  for (Json a : p.json["attributes"]) {
    const auto name = a.key();
    if (name == "POSITION" || name == "NORMAL" || name == "COLOR_0" || name.starts_with("JOINTS_") ||
        name.starts_with("WEIGHTS_"))
      continue;
    if (name != sets.light && (name != sets.texcoord || !materials_.texcoord_set(p.material)))
      c_.lost.add(name, c_.file.where(a));
  }
  c_.lost.keep(c_.file, p.json);
}

// ---- geometry of wrlkit --------------------------------------------------------------------------------------------

NodeId Meshes::own(const Primitive& p, Streams& s, const Look& look) {
  const auto corners = reader_.elements(p, s);
  const Json kept = vrml97(p.mesh);
  for (std::size_t i = 0; i < s.texcoord.values.size(); i += 2) {
    double& t = s.texcoord.values[i + 1];
    t = shortest(1 - t, [v = static_cast<float>(t)](double d) { return static_cast<float>(1 - d) == v; });
    if (!look.bake) continue;
    const auto& a = *look.bake;
    const double u = s.texcoord.values[i], v = t;
    auto rounded = [](double x) { return std::round(x * 1e7) / 1e7 + 0.0; };
    s.texcoord.values[i] = rounded(a.xx * u + a.xy * v + a.x);
    t = rounded(a.yx * u + a.yy * v + a.y);
  }
  for (std::size_t i = 1; i < s.light.values.size(); i += 2)
    s.light.values[i] = finite_decimal(static_cast<float>(1 - s.light.values[i]));
  // Lines and points of VRML have no alpha.
  if (s.color.width == 4 && !p.faces()) {
    if (without_alpha(s.color.values)) c_.lost.add("alpha of COLOR_0", c_.file.where(p.json));
    s.color.width = 3;
  }
  to_display(s.color.values, s.color.width == 4 ? 4 : 3);
  const TypeId type = p.faces()               ? nodes::IndexedFaceSet
                      : p.mode == points_mode ? nodes::PointSet
                                              : nodes::IndexedLineSet;
  NodeId n = c_.add(type, p.json);
  Json fields = kept[builtin_nodes()[type.value].name];
  note_first_vertices(n, p, corners);
  if (p.mode == points_mode) {
    NodeId coord = c_.add(nodes::Coordinate, p.json);
    std::vector<double> at, shade;
    for (auto v : corners) {
      at.insert(at.end(), s.position.values.begin() + 3 * v, s.position.values.begin() + 3 * v + 3);
      if (s.color) shade.insert(shade.end(), s.color.values.begin() + 3 * v, s.color.values.begin() + 3 * v + 3);
    }
    c_.scene.set(coord, nodes::coordinate::point, at);
    c_.scene.set(n, nodes::point_set::coord, coord);
    if (s.color) {
      NodeId color = c_.add(nodes::Color, p.json);
      c_.scene.set(color, nodes::color::color, shade);
      c_.scene.set(n, nodes::point_set::color, color);
    }
  } else if (p.faces()) {
    own_faces(n, p, s, corners);
    if (look.double_sided) c_.scene.set(n, nodes::indexed_face_set::solid, false);
  } else {
    own_lines(n, s, corners);
  }
  // What is left of the fields: nodes among them only say which there were, and their names.
  for (Json f : fields.is_object() ? fields : Json())
    if (auto slot = c_.scene.type(n).find(f.key(), Dialect::vrml97)) {
      if (info(c_.scene.type(n).fields[*slot].type).element == Element::node)
        name_attribute(c_.scene.value(n, *slot).node, f);
    }
  extras_.plain_fields(n, fields);
  extras_.tags(n, fields);
  return n;
}

void Meshes::note_first_vertices(NodeId n, const Primitive& p, const std::vector<std::uint32_t>& corners) {
  if (c_.file.is_own() && p.json["attributes"]["_FEATURE_ID_0"]) first_vertex_[n.value] = first_vertices(p, corners);
}

std::vector<std::uint32_t> Meshes::first_vertices(const Primitive& p, const std::vector<std::uint32_t>& corners) const {
  if (p.mode == points_mode) return corners;
  const auto faces = p.faces() ? polygons_of(corners, vrml97(p.mesh)["polygons"].numbers()) : polylines(corners);
  std::vector<std::uint32_t> out;
  for (std::size_t f = 0; f < faces.size(); ++f) out.push_back(faces.corners[faces.begin[f]]);
  return out;
}

/// For files that keep facts: of the attributes only the names are kept.
void Meshes::name_attributes(NodeId n, Json kept) {
  const Json fields = kept[c_.scene.type(n).name];
  for (Json f : fields.is_object() ? fields : Json())
    if (auto slot = c_.scene.type(n).find(f.key(), Dialect::vrml97);
        slot && info(c_.scene.type(n).fields[*slot].type).element == Element::node) {
      NodeId a = c_.scene.value(n, *slot).node;
      const auto name = f.is_object() && f.begin() != f.end() ? (*f.begin())["DEF"].text() : std::string_view();
      if (!a) continue;
      if (name.empty()) {
        extras_.tags(a, f.is_object() ? *f.begin() : Json());
        continue;
      }
      // Equal values are one node here, but two names are two.
      if (const auto other = c_.scene.name(a); !other.empty() && other != name) {
        const auto values = c_.scene.copy_of_fields(a);
        const NodeId own = c_.add(c_.scene.type_id(a), f);
        c_.scene.set_fields(own, values);
        c_.scene.set(n, c_.scene.make(FieldType::SFNode, *slot, own));
        a = own;
      }
      name_attribute(a, f);
    }
}

void Meshes::name_attribute(NodeId n, Json kept) {
  if (!n || kept.begin() == kept.end() || !kept.is_object()) return;
  c_.set_name(n, (*kept.begin())["DEF"]);
  extras_.tags(n, *kept.begin());
  extras_.define(n);
}

void Meshes::own_faces(NodeId n, const Primitive& p, const Streams& s, const std::vector<std::uint32_t>& corners) {
  namespace f = nodes::indexed_face_set;
  const Json kept = vrml97(p.mesh)["IndexedFaceSet"];
  const auto polygons = polygons_of(corners, vrml97(p.mesh)["polygons"].numbers());
  Scene& scene = c_.scene;
  const auto points_ = join(s.position.values, 3);
  const auto coord_index = index_of(polygons, points_.of_vertex);
  auto add = [&](TypeId type, FieldType field, std::uint16_t value_slot, std::uint16_t node_slot,
                 std::uint16_t index_slot, const Joined& j, bool per_vertex) {
    NodeId a = c_.add(type, p.json);
    scene.set(a, scene.make(field, value_slot, j.values));
    scene.set(n, scene.make(FieldType::SFNode, node_slot, a));
    auto index = per_vertex ? index_of(polygons, j.of_vertex) : face_index_of(polygons, j.of_vertex);
    if (per_vertex ? index != coord_index : !counts_up(index))
      scene.set(n, scene.make(FieldType::MFInt32, index_slot, index));
  };
  NodeId coord = c_.add(nodes::Coordinate, p.json);
  scene.set(coord, nodes::coordinate::point, points_.values);
  scene.set(n, f::coord, coord);
  const bool per_vertex = kept["colorPerVertex"].boolean(true);
  if (s.color && s.color.width == 4)
    add(nodes::ColorRGBA, FieldType::MFColorRGBA, nodes::color_rgba::color.slot, f::color.slot, f::colorIndex.slot,
        join(s.color.values, 4), per_vertex);
  else if (s.color)
    add(nodes::Color, FieldType::MFColor, nodes::color::color.slot, f::color.slot, f::colorIndex.slot,
        join(s.color.values, 3), per_vertex);
  if (s.normal && kept["normal"])
    add(nodes::Normal, FieldType::MFVec3f, nodes::normal::vector.slot, f::normal.slot, f::normalIndex.slot,
        join(s.normal.values, 3), kept["normalPerVertex"].boolean(true));
  if (s.texcoord && kept["texCoord"])
    add(nodes::TextureCoordinate, FieldType::MFVec2f, nodes::texture_coordinate::point.slot, f::texCoord.slot,
        f::texCoordIndex.slot, join(s.texcoord.values, 2), true);
  if (s.light)
    add(nodes::TextureCoordinate, FieldType::MFVec2f, nodes::texture_coordinate::point.slot, f::lightCoord.slot,
        f::lightCoordIndex.slot, join(s.light.values, 2), true);
  scene.set(n, f::coordIndex, coord_index);
}

void Meshes::own_lines(NodeId n, const Streams& s, const std::vector<std::uint32_t>& corners) {
  namespace f = nodes::indexed_line_set;
  const auto lines_ = polylines(corners);
  const auto points_ = join(s.position.values, 3);
  NodeId coord = c_.scene.add(nodes::Coordinate, c_.scene.where(n));
  c_.scene.set(coord, nodes::coordinate::point, points_.values);
  c_.scene.set(n, f::coord, coord);
  const auto index = index_of(lines_, points_.of_vertex);
  if (s.color) {
    const auto shades = join(s.color.values, 3);
    NodeId color = c_.scene.add(nodes::Color, c_.scene.where(n));
    c_.scene.set(color, nodes::color::color, shades.values);
    c_.scene.set(n, f::color, color);
    if (auto own_index = index_of(lines_, shades.of_vertex); own_index != index)
      c_.scene.set(n, f::colorIndex, own_index);
  }
  c_.scene.set(n, f::coordIndex, index);
}

}  // namespace wrlkit::gltf_reader
