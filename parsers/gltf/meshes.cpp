#include "parsers/gltf/meshes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "parsers/gltf/draco.h"
#include "parsers/gltf/features.h"
#include "parsers/gltf/polygons.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

enum Mode { points = 0, lines = 1, line_loop = 2, line_strip = 3, triangles = 4, triangle_strip = 5, triangle_fan = 6 };

/// The triangles or segments of a strip, fan or list of n vertices, as places in it.
std::vector<std::uint32_t> list_of(int mode, std::uint32_t n) {
  std::vector<std::uint32_t> out;
  auto add = [&](std::initializer_list<std::uint32_t> v) { out.insert(out.end(), v); };
  switch (mode) {
    case points:
      for (std::uint32_t i = 0; i < n; ++i) out.push_back(i);
      break;
    case lines:
      for (std::uint32_t i = 0; i + 1 < n; i += 2) add({i, i + 1});
      break;
    case line_loop:
    case line_strip:
      for (std::uint32_t i = 0; i + 1 < n; ++i) add({i, i + 1});
      if (mode == line_loop && n > 2) add({n - 1, 0});
      break;
    case triangles:
      for (std::uint32_t i = 0; i + 2 < n; i += 3) add({i, i + 1, i + 2});
      break;
    case triangle_strip:
      for (std::uint32_t i = 0; i + 2 < n; ++i) i % 2 ? add({i, i + 2, i + 1}) : add({i, i + 1, i + 2});
      break;
    default:
      for (std::uint32_t i = 1; i + 1 < n; ++i) add({i, i + 1, 0});
  }
  return out;
}

constexpr std::initializer_list<std::size_t> three{3}, two{2}, color_widths{3, 4};

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

bool is_identity_factor(const Vec3& f) { return f == Vec3{1, 1, 1}; }

}  // namespace

std::vector<Meshes::Part> Meshes::parts(std::uint32_t index, const Pose& pose) {
  std::vector<Part> out;
  morphs_.clear();
  unpacked_ids_.clear();
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
  if (is_whole) kind.given_texcoord = bool(kept["IndexedFaceSet"]["texCoord"]);
  const Look& look = materials_.get(p.material, kind);
  NodeId geometry;
  if (is_whole) {
    std::string key = look.double_sided ? "2" : "1";
    for (Json part : {attributes, p.json["indices"], p.json["mode"], p.mesh["name"], kept})
      (key += ' ') += part.source();
    NodeId& known = own_[key];
    if (known && how.shared()) return Part{look.appearance, known};
    if (NodeId whole = kept_whole(p)) return Part{look.appearance, known = whole};
    Streams s;
    if (!load(p, how, sets, s)) return std::nullopt;
    geometry = own(p, s, look);
    if (how.shared()) known = geometry;
  } else {
    Streams s;
    if (!load(p, how, sets, s)) return std::nullopt;
    geometry = foreign(p, s, look);
    if (!geometry) return std::nullopt;
    if (c_.file.is_own()) name_attributes(geometry, kept);
    if (!c_.file.is_own()) report_lost(p, sets);
  }
  if (p.mesh["primitives"].elements().size() == 1) c_.set_name(geometry, p.mesh["name"]);
  extras_.define(geometry);
  if (!morphs_.empty() && !morphs_.back().coordinate) {
    auto coord = p.faces()          ? nodes::indexed_face_set::coord.slot
                 : p.mode == points ? nodes::point_set::coord.slot
                                    : nodes::indexed_line_set::coord.slot;
    morphs_.back().coordinate = c_.scene.value(geometry, coord).node;
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
      packed ? rows_.ids(ids_of, std::exchange(unpacked_ids_, {})) : rows_.ids(ids_of, p.json["attributes"]);
  if (ids.empty()) return out;
  std::vector<std::uint32_t> of_face;
  for (auto v : first->second) of_face.push_back(v < ids.size() ? ids[v] : none);
  for (auto [row, geometry] : take_apart(c_.scene, whole.geometry, of_face))
    out.push_back({whole.appearance, geometry, row});
  return out;
}

/// Forms whose fields are all in extras; the mesh is what they look like.
NodeId Meshes::kept_whole(const Primitive& p) {
  const Json kept = vrml97(p.mesh);
  for (Json e : kept.is_object() ? kept : Json()) {
    const TypeId t = find_builtin(e.key(), Dialect::vrml97);
    if (!t || !builtin_nodes()[t.value].is_a("X3DGeometryNode")) continue;
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

// ---- vertices ------------------------------------------------------------------------------------------------------

bool Meshes::fill(Stream& s, std::initializer_list<std::size_t> widths) {
  if (s.accessor == none || !s.values.empty()) return true;
  auto read = c_.accessors.numbers(s.accessor, widths);
  if (!read) {
    s.accessor = none;
    return false;
  }
  s.width = read->width;
  s.values = std::move(read->values);
  return true;
}

Meshes::Stream Meshes::stream(const Primitive& p, std::string_view name, std::size_t n,
                              std::initializer_list<std::size_t> widths) {
  const Json a = p.json["attributes"][name];
  Stream s{c_.file.index(Table::accessors, a), *widths.begin(), {}};
  if (s.accessor == none) return s;
  if (c_.accessors.count(s.accessor) != n) {
    c_.diag().report(Diag::gltf_bad_value, c_.file.where(a), std::string(name) + " with another count than POSITION");
    s.accessor = none;
  } else if (c_.file.is_whole()) {
    fill(s, widths);
  }
  return s;
}

bool Meshes::load(const Primitive& p, const Pose& how, const Sets& sets, Streams& s) {
  if (p.json["extensions"]["KHR_draco_mesh_compression"]) {
    if (!load_draco(p, sets, s)) return false;
  } else {
    const Json position = p.json["attributes"]["POSITION"];
    auto accessor = c_.file.index(Table::accessors, position);
    if (accessor == none) {
      c_.diag().report(Diag::gltf_bad_value, c_.file.where(p.json), "primitive without POSITION");
      return false;
    }
    s.n = c_.accessors.count(accessor);
    s.position = {accessor, 3, {}};
    s.normal = stream(p, "NORMAL", s.n, three);
    s.color =
        stream(p, p.json["attributes"]["COLOR_0"] || !c_.file.is_whole() ? "COLOR_0" : "_COLOR", s.n, color_widths);
    s.texcoord = stream(p, sets.texcoord, s.n, two);
    if (!sets.light.empty()) s.light = stream(p, sets.light, s.n, two);
    if (p.json["indices"]) {
      s.index_accessor = c_.file.index(Table::accessors, p.json["indices"]);
      s.indexed = true;
      if (s.index_accessor == none) return false;
    }
  }
  const bool moved = !how.joints.empty() || !how.weights.empty() || p.json["targets"] || how.origin != Vec3{0, 0, 0};
  if ((c_.file.is_whole() || moved) && !fill(s.position, three)) return false;
  if (const double step = c_.file.is_whole() ? vrml97(p.mesh)["step"].number(1) : 1; step != 1)
    for (double& v : s.position.values) v = decimal(static_cast<float>(v * step));
  return !moved || pose(p, how, s);
}

bool Meshes::load_draco(const Primitive& p, const Sets& sets, Streams& s) {
  const Json ext = p.json["extensions"]["KHR_draco_mesh_compression"];
  auto view = c_.file.index(Table::bufferViews, ext["bufferView"]);
  auto bytes = view == none ? std::nullopt : c_.buffers.view(view);
  if (!bytes) return false;
  struct Row {
    const char* name;
    Stream* to;
    std::size_t width;
  };
  const std::string color_type(
      c_.file.at(Table::accessors, p.json["attributes"]["COLOR_0"].whole().value_or(none))["type"].text());
  const Row rows[] = {{"POSITION", &s.position, 3},
                      {"NORMAL", &s.normal, 3},
                      {"COLOR_0", &s.color, color_type == "VEC4" ? 4u : 3u},
                      {sets.texcoord.c_str(), &s.texcoord, 2},
                      {sets.light.c_str(), &s.light, 2},
                      {"_FEATURE_ID_0", &s.feature, 1}};
  std::vector<DracoAttribute> wanted;
  std::vector<const Row*> used;
  for (const Row& r : rows)
    if (auto id = ext["attributes"][r.name].whole(); id && *id < none) {
      wanted.push_back({static_cast<std::uint32_t>(*id), static_cast<std::uint32_t>(r.width), {}});
      used.push_back(&r);
    }
  auto index = draco_unpack(bytes->bytes, wanted);
  if (!index) {
    c_.diag().report(Diag::gltf_packed, c_.file.where(ext), "KHR_draco_mesh_compression");
    return false;
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    used[i]->to->width = used[i]->width;
    used[i]->to->values = std::move(wanted[i].values);
    for (double& v : used[i]->to->values) v = decimal(static_cast<float>(v));
  }
  if (s.position.values.empty()) {
    c_.diag().report(Diag::gltf_bad_value, c_.file.where(p.json), "primitive without POSITION");
    return false;
  }
  s.n = s.position.values.size() / 3;
  unpacked_ids_ = std::move(s.feature.values);
  s.index = std::move(*index);
  s.indexed = s.loose = true;
  return true;
}

bool Meshes::pose(const Primitive& p, const Pose& how, Streams& s) {
  n_posed_ += s.n;
  if (n_posed_ > max_posed) {
    c_.diag().report(Diag::expansion_limit, c_.file.where(p.json), max_posed, "vertices of posed meshes");
    return false;
  }
  s.loose = true;
  fill(s.normal, three);
  for (std::size_t i = 0; i < s.position.values.size(); ++i) s.position.values[i] += how.origin[i % 3];
  if (p.json["targets"]) morph(p, how, s);
  return how.joints.empty() || skin(p, how, s);
}

void Meshes::morph(const Primitive& p, const Pose& how, Streams& s) {
  Morph m;
  m.base = s.position.values;
  m.weights = how.weights.empty() ? p.mesh["weights"].numbers() : how.weights;
  for (Json target : p.json["targets"].elements()) {
    for (Json a : target)
      if (a.key() != "POSITION" && a.key() != "NORMAL")
        c_.lost.add("morph target of " + std::string(a.key()), c_.file.where(a));
    auto moves = c_.accessors.numbers(c_.file.index(Table::accessors, target["POSITION"]), three);
    auto turns = c_.accessors.numbers(c_.file.index(Table::accessors, target["NORMAL"]), three);
    const std::size_t k = m.targets.size();
    const double w = k < m.weights.size() ? m.weights[k] : 0;
    n_posed_ += s.n;
    if (n_posed_ > max_posed)
      return c_.diag().report(Diag::expansion_limit, c_.file.where(p.json), max_posed, "vertices of posed meshes");
    m.targets.push_back(moves && moves->count() == s.n ? std::move(moves->values) : std::vector<double>(s.n * 3, 0.0));
    for (std::size_t i = 0; i < s.n * 3; ++i) s.position.values[i] += w * m.targets.back()[i];
    if (turns && turns->count() == s.n && s.normal.values.size() == s.n * 3)
      for (std::size_t i = 0; i < s.n * 3; ++i) s.normal.values[i] += w * turns->values[i];
  }
  m.weights.resize(m.targets.size(), 0.0);
  morphs_.push_back(std::move(m));
}

/// Each vertex by the mean of its joints' matrices.
bool Meshes::skin(const Primitive& p, const Pose& how, Streams& s) {
  std::vector<Matrix> sum(s.n, Matrix{{}});
  std::vector<double> weight(s.n, 0.0);
  for (int set = 0;; ++set) {
    const auto suffix = std::to_string(set);
    const Json joints = p.json["attributes"]["JOINTS_" + suffix], weights = p.json["attributes"]["WEIGHTS_" + suffix];
    if (!joints || !weights) break;
    auto j = c_.accessors.whole(c_.file.index(Table::accessors, joints), 4);
    auto w = c_.accessors.numbers(c_.file.index(Table::accessors, weights), {4});
    if (!j || !w || j->size() != s.n * 4 || w->values.size() != s.n * 4) break;
    for (std::size_t i = 0; i < s.n * 4; ++i) {
      const double share = w->values[i];
      if (!(share > 0) || (*j)[i] >= how.joints.size()) continue;
      for (std::size_t k = 0; k < 12; ++k) sum[i / 4].m[k] += share * how.joints[(*j)[i]].m[k];
      weight[i / 4] += share;
    }
  }
  for (std::size_t i = 0; i < s.n; ++i) {
    if (!(weight[i] > 0)) continue;
    Matrix& m = sum[i];
    for (double& v : m.m) v /= weight[i];
    double* q = &s.position.values[i * 3];
    const Vec3 moved = m.point({q[0], q[1], q[2]});
    std::ranges::copy(moved, q);
    if (s.normal.values.size() != s.n * 3) continue;
    double* nv = &s.normal.values[i * 3];
    const Vec3 to = m.point({nv[0], nv[1], nv[2]}), from = m.point({0, 0, 0});
    Vec3 d{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    const double length = std::hypot(d[0], d[1], d[2]);
    for (std::size_t k = 0; k < 3 && length > 0; ++k) nv[k] = decimal(static_cast<float>(d[k] / length));
  }
  return true;
}

std::vector<std::uint32_t> Meshes::elements(const Primitive& p, Streams& s) {
  if (s.index_accessor != none)
    if (auto read = c_.accessors.whole(s.index_accessor)) s.index = std::move(*read);
  const std::size_t n = s.indexed ? s.index.size() : s.n;
  auto out = list_of(p.mode, static_cast<std::uint32_t>(std::min<std::size_t>(n, none - 1)));
  if (s.indexed)
    for (auto& v : out) v = s.index[v];
  const std::size_t size = p.faces() ? 3 : p.mode == points ? 1 : 2;
  std::size_t bad = 0, to = 0;
  for (std::size_t i = 0; i + size <= out.size(); i += size) {
    const bool outside =
        std::any_of(out.begin() + static_cast<std::ptrdiff_t>(i), out.begin() + static_cast<std::ptrdiff_t>(i + size),
                    [&](auto v) { return v >= s.n; });
    const bool flat = size == 3 && (out[i] == out[i + 1] || out[i + 1] == out[i + 2] ||
                                    out[i] == out[i + 2]);  // strips turn with such
    bad += outside;
    if (outside || flat) continue;
    for (std::size_t k = 0; k < size; ++k) out[to++] = out[i + k];
  }
  out.resize(to);
  if (bad > 0) c_.diag().report(Diag::bad_index, c_.file.where(p.json), "primitive", bad, n / size);
  return out;
}

// ---- geometry of others --------------------------------------------------------------------------------------------

NodeId Meshes::attribute(TypeId type, std::uint16_t slot, FieldType field, Stream& s, int variant, bool loose,
                         const std::function<void(std::vector<double>&)>& change) {
  NodeId unshared;
  NodeId& known = loose ? unshared : attributes_[{type.value, s.accessor, variant}];
  if (known) return known;
  const auto widths = type == nodes::TextureCoordinate ? two : type == nodes::Color ? color_widths : three;
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

NodeId Meshes::foreign(const Primitive& p, Streams& s, const Look& look) {
  const auto nothing = [](std::vector<double>&) {};
  NodeId coord, normal, color, texcoord;
  const int variant = is_identity_factor(look.color_factor) && !look.bake ? 0 : static_cast<int>(p.material) + 1;
  coord =
      attribute(nodes::Coordinate, nodes::coordinate::point.slot, FieldType::MFVec3f, s.position, 0, s.loose, nothing);
  if (!coord) return {};
  if (s.normal && p.faces())
    normal = attribute(nodes::Normal, nodes::normal::vector.slot, FieldType::MFVec3f, s.normal, 0, s.loose, nothing);
  if (s.color)
    color = attribute(nodes::Color, nodes::color::color.slot, FieldType::MFColor, s.color, variant, s.loose,
                      [&](std::vector<double>& v) {
                        if (s.color.width == 4 && without_alpha(v))
                          c_.lost.add("alpha of COLOR_0", c_.file.where(p.json));
                        for (std::size_t i = 0; i < v.size(); ++i)
                          v[i] = display(static_cast<float>(v[i] * look.color_factor[i % 3]));
                      });
  if (s.texcoord && p.faces() && look.textured)
    texcoord = attribute(nodes::TextureCoordinate, nodes::texture_coordinate::point.slot, FieldType::MFVec2f,
                         s.texcoord, variant, s.loose, [&](std::vector<double>& v) {
                           const auto a = look.bake.value_or(TexcoordMap{});
                           for (std::size_t i = 0; i + 1 < v.size(); i += 2) {
                             const double u = v[i], t = std::round((1 - v[i + 1]) * 1e9) / 1e9;
                             v[i] = look.bake ? a.xx * u + a.xy * t + a.x : u;
                             v[i + 1] = look.bake ? a.yx * u + a.yy * t + a.y : t;
                           }
                         });
  NodeId light;
  if (s.light)
    light = attribute(nodes::TextureCoordinate, nodes::texture_coordinate::point.slot, FieldType::MFVec2f, s.light, -1,
                      s.loose, [](std::vector<double>& v) {
                        for (std::size_t i = 1; i < v.size(); i += 2) v[i] = std::round((1 - v[i]) * 1e9) / 1e9;
                      });
  const auto corners = elements(p, s);
  Scene& scene = c_.scene;
  if (p.mode == points) {
    NodeId n = c_.add(nodes::PointSet, p.json);
    note_first_vertices(n, p, corners);
    if (s.indexed) {  // a PointSet has no indices
      auto gather = [&](NodeId from, std::uint16_t slot, TypeId type) {
        auto all = scene.value(from, slot).number_span();
        std::vector<double> some;
        for (auto v : corners) some.insert(some.end(), all.begin() + 3 * v, all.begin() + 3 * v + 3);
        NodeId to = c_.add(type, p.json);
        scene.set(to, scene.make(type == nodes::Color ? FieldType::MFColor : FieldType::MFVec3f, slot, some));
        return to;
      };
      coord = gather(coord, nodes::coordinate::point.slot, nodes::Coordinate);
      if (color) color = gather(color, nodes::color::color.slot, nodes::Color);
    }
    scene.set(n, nodes::point_set::coord, coord);
    if (color) scene.set(n, nodes::point_set::color, color);
    return n;
  }
  NodeId n = c_.add(p.faces() ? nodes::IndexedFaceSet : nodes::IndexedLineSet, p.json);
  note_first_vertices(n, p, corners);
  Value index = scene.make(FieldType::MFInt32, 0, p.faces() ? faces_of(corners) : polylines_of(corners));
  if (!s.loose) {
    auto [i, is_new] = coord_index_.try_emplace({p.mode, s.index_accessor, s.n}, index);
    index = i->second;
  }
  if (!p.faces()) {
    namespace f = nodes::indexed_line_set;
    scene.set(n, f::coord, coord);
    if (color) scene.set(n, f::color, color);
    index.slot = f::coordIndex.slot;
    scene.set(n, index);
    return n;
  }
  namespace f = nodes::indexed_face_set;
  scene.set(n, f::coord, coord);
  if (normal) scene.set(n, f::normal, normal);
  if (color) scene.set(n, f::color, color);
  if (texcoord) scene.set(n, f::texCoord, texcoord);
  if (light) scene.set(n, f::lightCoord, light);
  if (look.double_sided) scene.set(n, f::solid, false);
  index.slot = f::coordIndex.slot;
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
  const auto corners = elements(p, s);
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
    s.light.values[i] = decimal(static_cast<float>(1 - s.light.values[i]));
  if (s.color.width == 4) without_alpha(s.color.values);
  for (double& v : s.color.values) v = display(static_cast<float>(v));
  const TypeId type = p.faces() ? nodes::IndexedFaceSet : p.mode == points ? nodes::PointSet : nodes::IndexedLineSet;
  NodeId n = c_.add(type, p.json);
  Json fields = kept[builtin_nodes()[type.value].name];
  note_first_vertices(n, p, corners);
  if (p.mode == points) {
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
  return n;
}

void Meshes::note_first_vertices(NodeId n, const Primitive& p, const std::vector<std::uint32_t>& corners) {
  if (c_.file.is_own() && p.json["attributes"]["_FEATURE_ID_0"]) first_vertex_[n.value] = first_vertices(p, corners);
}

std::vector<std::uint32_t> Meshes::first_vertices(const Primitive& p, const std::vector<std::uint32_t>& corners) const {
  if (p.mode == points) return corners;
  const auto faces = p.faces() ? polygons_of(corners, vrml97(p.mesh)["polygons"].numbers()) : polylines(corners);
  std::vector<std::uint32_t> out;
  for (std::size_t f = 0; f < faces.size(); ++f) out.push_back(faces.corners[faces.begin[f]]);
  return out;
}

/// Of files that keep facts: the names are all that is said of them.
void Meshes::name_attributes(NodeId n, Json kept) {
  const Json fields = kept[c_.scene.type(n).name];
  for (Json f : fields.is_object() ? fields : Json())
    if (auto slot = c_.scene.type(n).find(f.key(), Dialect::vrml97);
        slot && info(c_.scene.type(n).fields[*slot].type).element == Element::node) {
      NodeId a = c_.scene.value(n, *slot).node;
      const auto name = f.is_object() && f.begin() != f.end() ? (*f.begin())["DEF"].text() : std::string_view();
      if (!a || name.empty()) continue;
      // Equal values are one node here, but two names are two.
      if (const auto other = c_.scene.name(a); !other.empty() && other != name) {
        const std::vector<Value> values(c_.scene.fields(a).begin(), c_.scene.fields(a).end());
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
  if (s.color)
    add(nodes::Color, FieldType::MFColor, nodes::color::color.slot, f::color.slot, f::colorIndex.slot,
        join(s.color.values, 3), kept["colorPerVertex"].boolean(true));
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
