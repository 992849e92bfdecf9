#include "parsers/gltf/hierarchy.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "base/math/affine.h"
#include "parsers/gltf/bounds.h"
#include "parsers/gltf/visibility.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

constexpr double half_field_of_view = 0.785398 / 2;

Json instancing(Json node) { return node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]; }
Json lod_of(Json node) { return node["extensions"]["MSFT_lod"]["ids"]; }

/// Types that glTF has elements for: what another program made of those is believed, not the extras.
bool is_said_by_gltf(TypeId t) {
  constexpr TypeId types[] = {nodes::Group,      nodes::Transform,        nodes::Shape,    nodes::Viewpoint, nodes::LOD,
                              nodes::PointLight, nodes::DirectionalLight, nodes::SpotLight};
  return std::ranges::find(types, t) != std::end(types);
}

std::optional<std::uint16_t> children_slot(const NodeType& t) {
  auto f = std::ranges::find(t.fields, "children", &FieldDef::name);
  if (f == t.fields.end() || !t.is_a(nodes::X3DGroupingNode)) return std::nullopt;
  return static_cast<std::uint16_t>(f - t.fields.begin());
}

bool has_matrix(const Json& fields) { return fields["center"] || (fields["scaleOrientation"] && fields["scale"]); }

}  // namespace

Hierarchy::Hierarchy(const Context& c, Extras& extras, Meshes& meshes, PartRows& rows, const ParseLimits& limits,
                     std::set<std::uint32_t> moved)
    : c_(c),
      extras_(extras),
      meshes_(meshes),
      rows_(rows),
      limits_(limits),
      moved_(std::move(moved)),
      parent_(c.file.count(Table::nodes), none),
      state_(parent_.size()),
      made_(parent_.size()) {}

void Hierarchy::find_parents() {
  for (std::uint32_t n = 0; n < parent_.size(); ++n)
    for (Json c : c_.file.at(Table::nodes, n)["children"].elements())
      if (auto i = c.whole(); i && *i < parent_.size() && parent_[*i] == none) parent_[*i] = n;
}

void Hierarchy::build() {
  find_parents();
  auto shown = c_.file.index(Table::scenes, c_.file.root()["scene"]);
  if (shown == none && c_.file.count(Table::scenes) > 0) shown = 0;
  std::vector<NodeId> hidden;
  auto add = [&](Json scene) {
    Nodes all;
    Vec3 origin{0, 0, 0};
    // Programs that have worked on the file since leave it where it is.
    if (auto v = vrml97(scene)["origin"].numbers(); v.size() == 3) origin = {v[0], v[1], v[2]};
    PartGroups groups;
    part_groups_ = &groups;
    for (Json n : scene["nodes"].elements())
      if (auto i = c_.file.index(Table::nodes, n); i != none) visit(i, 0, origin, all);
    if (c_.file.is_own()) groups.put_empty(c_.scene, rows_, all);
    groups.finish(c_.scene);
    part_groups_ = nullptr;
    c_.lost.keep(c_.file, scene);
    return all;
  };
  Nodes roots;
  if (shown != none)
    roots = add(c_.file.at(Table::scenes, shown));
  else  // a library of nodes: all of them
    for (std::uint32_t n = 0; n < parent_.size(); ++n)
      if (parent_[n] == none) visit(n, 0, {}, roots);
  roots.insert(roots.end(), suns_.begin(), suns_.end());
  for (std::uint32_t s = 0; s < c_.file.count(Table::scenes); ++s) {
    if (s == shown) continue;
    suns_.clear();
    const Json scene = c_.file.at(Table::scenes, s);
    NodeId group = c_.add(nodes::Group, scene);
    auto all = add(scene);
    all.insert(all.end(), suns_.begin(), suns_.end());
    c_.scene.set(group, nodes::group::children, all);
    c_.set_name(group, scene["name"]);
    hidden.push_back(group);
  }
  if (!hidden.empty()) {
    NodeId choice = c_.add(nodes::Switch, c_.file.root()["scenes"]);
    c_.scene.set(choice, nodes::switch_::children, hidden);
    roots.push_back(choice);
    c_.diag().report(Diag::gltf_scenes, c_.file.where(c_.file.root()["scenes"]), hidden.size());
  }
  c_.scene.main.roots = std::move(roots);
}

void Hierarchy::visit(std::uint32_t n, std::size_t depth, const Vec3& origin, Nodes& out) {
  const Json json = c_.file.at(Table::nodes, n);
  if (state_[n] == State::open) return c_.diag().report(Diag::gltf_cycle, c_.file.where(json), n);
  if (state_[n] == State::done) {
    // Scenes may share their roots.
    if (depth > 0 || parent_[n] != none) c_.diag().report(Diag::gltf_two_parents, c_.file.where(json), n);
    if (made_[n]) out.push_back(made_[n]);
    return;
  }
  if (depth + 4 > limits_.depth) return c_.diag().report(Diag::too_deep, c_.file.where(json), limits_.depth);
  state_[n] = State::open;
  const auto before = out.size();
  const Json levels = lod_of(json);
  if (levels && !c_.file.is_whole())
    level_of_detail(n, depth, origin, out);
  else
    make(n, depth, origin, out);
  if (out.size() == before + 1) made_[n] = out.back();
  if (is_hidden(json) && !is_choice(n)) hide(c_, json, before, out);
  if (levels && c_.file.is_whole()) add_levels(levels, depth, origin, out);
  state_[n] = State::done;
}

/// A child of what comes back as a Switch, which hides it itself.
bool Hierarchy::is_choice(std::uint32_t n) const {
  return c_.file.is_own() && parent_[n] != none && vrml97(c_.file.at(Table::nodes, parent_[n]))["Switch"];
}

Hierarchy::Nodes Hierarchy::children(std::uint32_t n, std::size_t depth, const Vec3& origin) {
  Nodes out;
  PartGroups groups;
  auto* above = std::exchange(part_groups_, &groups);
  for (Json c : c_.file.at(Table::nodes, n)["children"].elements())
    if (auto i = c_.file.index(Table::nodes, c); i != none) visit(i, depth + 1, origin, out);
  part_groups_ = above;
  groups.finish(c_.scene);
  return out;
}

void Hierarchy::make(std::uint32_t n, std::size_t depth, Vec3 origin, Nodes& out) {
  const Json json = c_.file.at(Table::nodes, n), extras = vrml97(json);
  TransformFields place = place_of(json);
  if (c_.file.is_own() && instancing(json) && c_.file.index(Table::meshes, json["mesh"]) != none) {
    return own_instances(n, origin, out);
  }
  const bool passes_on =
      place.is_identity() && !json["translation"] && !json["mesh"] && !json["camera"] && !light_of(json);
  if (!passes_on) {
    place.translation = place.translation + origin;
    if (origin != Vec3{0, 0, 0} && !c_.file.is_own()) moved_back_.emplace(n, origin);
    origin = {};
  }
  if (extras.is_object() && extras.begin() == extras.end() && c_.file.is_own()) {  // a helper
    auto all = light_of(json) ? Nodes() : children(n, depth, origin);
    out.insert(out.end(), all.begin(), all.end());
    return;
  }
  Json type;
  if (extras.is_object() && extras.begin() != extras.end()) type = *extras.begin();
  if (type.key() == "USE" && c_.file.is_own()) {
    if (auto i = c_.file.index(Table::nodes, type); i != none && made_[i]) return out.push_back(made_[i]);
    type = {};
  }
  const bool known =
      type.is_object() && (c_.file.is_own() || !is_said_by_gltf(find_builtin(type.key(), Dialect::vrml97)));
  auto below = children(n, depth, origin);
  // Parts of a merged mesh stand by themselves.
  if (auto mesh = c_.file.index(Table::meshes, json["mesh"]);
      mesh != none && !type && below.empty() && place.is_identity() && meshes_.has_features(mesh)) {
    auto parts = shapes(n, place);
    out.insert(out.end(), parts.begin(), parts.end());
    return;
  }
  NodeId made = known ? kept(n, type, place, std::move(below)) : implied(n, place, std::move(below));
  if (!c_.file.is_own()) report(json);
  if (made) {
    extras_.define(made);
    out.push_back(made);
  }
}

void Hierarchy::report(Json json) { c_.lost.keep(c_.file, json); }

// ---- nodes that wrlkit has written ---------------------------------------------------------------------------------

NodeId Hierarchy::kept(std::uint32_t n, Json fields, const TransformFields& place, Nodes below) {
  const Json json = c_.file.at(Table::nodes, n);
  const TypeId type = extras_.type(fields.key(), fields);
  if (!c_.file.is_whole() && json["mesh"] && is_said_by_gltf(type)) {
    // Of a file of facts only what is said of the node; where it stands may be that of several nodes of VRML.
    const NodeId node = implied(n, place, std::move(below));
    if (node) extras_.tags(node, fields);
    return node;
  }
  NodeId made = c_.add(type, fields);
  const bool viewpoint = type == nodes::Viewpoint || type == nodes::OrthoViewpoint, shape_ = type == nodes::Shape;
  if (shape_) {
    if (auto parts = shapes(n, place); !parts.empty()) made = parts[0];
  } else if (type == nodes::OrthoViewpoint) {
    orthographic_camera(made, json, place);
  } else if (viewpoint) {
    made = camera(json, place);
  } else if (type == nodes::PointLight || type == nodes::DirectionalLight || type == nodes::SpotLight) {
    light_fields(made, {}, place);
  } else if (type == nodes::Transform && !has_matrix(fields)) {
    made = transform(json, place, {}, true);
  } else {
    auto own = shapes(n, place);
    below.insert(below.begin(), own.begin(), own.end());
  }
  if (type == nodes::Transform && !has_matrix(fields)) {
    auto own = shapes(n, place);
    below.insert(below.begin(), own.begin(), own.end());
  }
  // Long texts and nodes are written once, where the file and its scene describe themselves: those of the first.
  if (type == nodes::WorldInfo && !std::exchange(has_world_info_, true))
    extras_.fields(made, vrml97(c_.file.root()["asset"])["WorldInfo"]);
  if (type == nodes::NavigationInfo && !std::exchange(has_navigation_info_, true))
    extras_.fields(made,
                   vrml97(c_.file.at(Table::scenes, c_.file.root()["scene"].whole().value_or(0)))["NavigationInfo"]);
  std::deque<NodeId> rest(below.begin(), below.end());
  extras_.fields(made, fields, rest);
  if (auto slot = children_slot(c_.scene.type(made)); slot && !rest.empty()) {
    std::vector<NodeId> all;
    if (auto* v = c_.scene.find(made, *slot)) all.assign(v->node_span().begin(), v->node_span().end());
    all.insert(all.end(), rest.begin(), rest.end());
    c_.scene.set(made, c_.scene.make(FieldType::MFNode, *slot, all));
  }
  if (fields["DEF"])
    c_.set_name(made, fields["DEF"]);
  else if (!viewpoint || fields["description"].text() != json["name"].text())
    c_.set_name(made, json["name"]);
  return made;
}

// ---- nodes of glTF -------------------------------------------------------------------------------------------------

NodeId Hierarchy::implied(std::uint32_t n, const TransformFields& place, Nodes below) {
  const Json json = c_.file.at(Table::nodes, n);
  const bool has_camera = bool(json["camera"]), has_light = bool(light_of(json)), has_mesh = bool(json["mesh"]);
  const bool moved = moved_.contains(n);
  const bool alone = !moved && below.empty() && has_camera + has_light + has_mesh == 1 && !instancing(json);
  NodeId made;
  if (alone && has_camera) {
    made = camera(json, place);
  } else if (alone && has_light) {
    made = light(json, place, world(n));
  } else {
    auto own = has_mesh ? shapes(n, place) : Nodes();
    if (alone && place.is_identity() && own.size() == 1) {
      made = own[0];
    } else {
      if (has_camera) own.push_back(camera(json, {}));
      if (NodeId l = has_light ? light(json, {}, world(n)) : NodeId{}) own.push_back(l);
      own.insert(own.end(), below.begin(), below.end());
      made = transform(json, place, own, moved);
    }
  }
  if (made) c_.set_name(made, json["name"]);
  return made;
}

NodeId Hierarchy::transform(Json at, const TransformFields& p, const Nodes& below, bool moved) {
  namespace f = nodes::transform;
  if (p.is_identity() && !moved) {
    NodeId n = c_.add(nodes::Group, at);
    if (!below.empty()) c_.scene.set(n, nodes::group::children, below);
    return n;
  }
  NodeId n = c_.add(nodes::Transform, at);
  if (p.translation != Vec3{0, 0, 0}) c_.scene.set(n, f::translation, p.translation);
  if (p.rotation[3] != 0) c_.scene.set(n, f::rotation, p.rotation);
  if (p.scales()) c_.scene.set(n, f::scale, p.scale);
  if (p.scales() && p.scale_orientation[3] != 0) c_.scene.set(n, f::scaleOrientation, p.scale_orientation);
  if (!below.empty()) c_.scene.set(n, f::children, below);
  return n;
}

/// The one node that a level is: parts of a merged mesh are many. Null where nothing is made.
NodeId Hierarchy::level(Json at, const std::function<void(Nodes&)>& make_nodes) {
  Nodes made;
  PartGroups groups;
  auto* above = std::exchange(part_groups_, &groups);
  make_nodes(made);
  part_groups_ = above;
  groups.finish(c_.scene);
  if (made.size() < 2) return made.empty() ? NodeId{} : made[0];
  const NodeId group = c_.scene.add(nodes::Group, c_.file.where(at));
  c_.scene.set(group, nodes::group::children, made);
  return group;
}

void Hierarchy::add_levels(Json ids, std::size_t depth, const Vec3& origin, Nodes& out) {
  for (Json id : ids.elements()) {
    const auto i = c_.file.index(Table::nodes, id);
    if (i == none) continue;
    const NodeId shown = level(id, [&](Nodes& made) { visit(i, depth, origin, made); });
    if (shown) out.push_back(shown);
  }
}

/// MSFT_lod: a level is shown down to a part of the window's height, VRML's up to a distance.
void Hierarchy::level_of_detail(std::uint32_t n, std::size_t depth, const Vec3& origin, Nodes& out) {
  const Json json = c_.file.at(Table::nodes, n);
  Nodes levels;
  levels.push_back(level(json, [&](Nodes& made) { make(n, depth, origin, made); }));
  if (!levels[0]) return;
  add_levels(lod_of(json), depth + 1, origin, levels);
  NodeId lod = c_.add(nodes::LOD, json);
  c_.scene.set(lod, nodes::lod::children, levels);
  const auto ball = bounds_below(c_.file, n);
  const auto coverage = json["extras"]["MSFT_screencoverage"].numbers();
  std::vector<double> range;
  for (std::size_t i = 0; i + 1 < levels.size() && i < coverage.size() && coverage[i] > 0 && ball.radius > 0; ++i)
    range.push_back(
        std::max(range.empty() ? 0 : range.back(), ball.radius / (coverage[i] * std::tan(half_field_of_view))));
  if (range.size() + 1 == levels.size()) {
    c_.scene.set(lod, nodes::lod::range, range);
    const Vec3 center = ball.center + origin;
    if (center != Vec3{0, 0, 0}) c_.scene.set(lod, nodes::lod::center, center);
  }
  out.push_back(lod);
}

NodeId Hierarchy::shape(const Meshes::Part& part, Json at) {
  NodeId n = c_.add(nodes::Shape, at);
  if (part.appearance) c_.scene.set(n, nodes::shape::appearance, part.appearance);
  if (part.geometry) c_.scene.set(n, nodes::shape::geometry, part.geometry);
  return n;
}

Hierarchy::Nodes Hierarchy::shapes(std::uint32_t n, const TransformFields& place) {
  const Json json = c_.file.at(Table::nodes, n);
  auto mesh = c_.file.index(Table::meshes, json["mesh"]);
  if (mesh == none) return {};
  Pose p = pose(n);
  if (c_.file.is_whole() && vrml97(json)["Shape"]) p.origin = place.translation;
  Nodes out;
  PartGroups apart;
  auto& groups = place.is_identity() && part_groups_ ? *part_groups_ : apart;
  for (const auto& part : meshes_.parts(mesh, p)) groups.put(c_.scene, rows_, part.row, shape(part, json), out);
  apart.finish(c_.scene);
  if (auto m = meshes_.take_morphs(); !m.empty()) morphs_[n] = std::move(m);
  if (instancing(json)) instances(json, out);
  return out;
}

std::vector<TransformFields> Hierarchy::places(Json attributes) {
  auto read = [&](const char* name, std::size_t width) {
    return c_.accessors.numbers(c_.file.index(Table::accessors, attributes[name]), {width});
  };
  auto t = read("TRANSLATION", 3), r = read("ROTATION", 4), s = read("SCALE", 3);
  const std::size_t n = std::max({t ? t->count() : 0, r ? r->count() : 0, s ? s->count() : 0});
  const auto is_read = [&](std::string_view key) {
    return key == "TRANSLATION" || key == "ROTATION" || key == "SCALE" ||
           (c_.file.is_own() && key == "_FEATURE_ID_0");  // rows of parts, which have names and ways (part_rows.h)
  };
  for (Json a : attributes)
    if (!is_read(a.key())) c_.lost.add("instances' " + std::string(a.key()), c_.file.where(a));
  std::vector<TransformFields> all;
  for (std::size_t i = 0; i < n; ++i) {
    if (++n_instances_ > max_instances) {
      c_.diag().report(Diag::expansion_limit, c_.file.where(attributes), max_instances, "instances");
      break;
    }
    TransformFields& p = all.emplace_back();
    if (t && i < t->count()) p.translation = {t->at(i)[0], t->at(i)[1], t->at(i)[2]};
    if (r && i < r->count()) p.rotation = rotation_of({r->at(i)[0], r->at(i)[1], r->at(i)[2], r->at(i)[3]});
    if (s && i < s->count()) p.scale = {s->at(i)[0], s->at(i)[1], s->at(i)[2]};
  }
  return all;
}

/// A Transform with the same Shapes for each. Names are where wrlkit writes them (gltf_instances.h).
void Hierarchy::instances(Json node, Nodes& shapes) {
  const Json at = instancing(node);
  Nodes all;
  for (const TransformFields& p : places(at)) all.push_back(transform(at, p, shapes));
  std::size_t i = 0;
  for (Json name : node["extras"]["names"].elements())
    if (i < all.size()) c_.set_name(all[i++], name);
  shapes = std::move(all);
}

/// Each is what a node with the mesh would be, in the group that its row of the table of parts is in.
void Hierarchy::own_instances(std::uint32_t n, const Vec3& origin, Nodes& out) {
  const Json json = c_.file.at(Table::nodes, n), at = instancing(json);
  const auto names = json["extras"]["names"].elements(),
             sets = json["extensions"]["EXT_instance_features"]["featureIds"].elements();
  const auto ids = sets.empty() ? std::vector<std::uint32_t>() : rows_.ids(sets[0], at);
  const auto mesh = c_.file.index(Table::meshes, json["mesh"]);
  PartGroups apart;
  auto& groups = part_groups_ ? *part_groups_ : apart;
  std::size_t i = 0;
  for (TransformFields p : places(at)) {
    for (std::size_t k = 0; k < 3; ++k) p.translation[k] += origin[k];
    Nodes own;
    for (const auto& part : meshes_.parts(mesh, pose(n))) own.push_back(shape(part, json));
    const NodeId made = p.is_identity() && own.size() == 1 ? own[0] : transform(at, p, own);
    std::uint32_t row = i < ids.size() && ids[i] < rows_.rows().size() ? ids[i] : none;
    if (row != none && !rows_.is_group(row)) {
      const PartRow& part = rows_.rows()[row];
      rows_.set_made(row, made);
      if (!part.name.empty()) c_.scene.set_name(made, part.name);
      row = part.parent;
    } else if (i < names.size()) {
      c_.set_name(made, names[i]);
    }
    groups.put(c_.scene, rows_, row, made, out);
    extras_.define(made);
    ++i;
  }
  apart.finish(c_.scene);
}

// ---- skins ---------------------------------------------------------------------------------------------------------

Matrix Hierarchy::world(std::uint32_t n) {
  Matrix m;
  for (std::size_t up = 0; n != none && up < limits_.depth; ++up, n = parent_[n])
    m = matrix_of(place_of(c_.file.at(Table::nodes, n))) * m;
  return m;
}

Pose Hierarchy::pose(std::uint32_t n) {
  const Json json = c_.file.at(Table::nodes, n);
  Pose p;
  p.weights = json["weights"].numbers();
  p.skin = c_.file.index(Table::skins, json["skin"]);
  if (p.skin == none) return p;
  const Json skin = c_.file.at(Table::skins, p.skin);
  auto bind = c_.accessors.numbers(c_.file.index(Table::accessors, skin["inverseBindMatrices"]), {16});
  const Matrix back = inverse(world(n));
  for (Json j : skin["joints"].elements()) {
    auto joint = c_.file.index(Table::nodes, j);
    Matrix m = joint == none ? Matrix() : back * world(joint);
    const bool is_bound = bind && p.joints.size() < bind->count();
    p.joints.push_back(m * (is_bound ? matrix_of_columns(bind->at(p.joints.size())) : Matrix()));
  }
  c_.lost.add("skin (posed as it stands)", c_.file.where(json));
  return p;
}

}  // namespace wrlkit::gltf_reader
