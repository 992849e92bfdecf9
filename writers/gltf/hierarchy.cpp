#include "writers/gltf/hierarchy.h"

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "writers/gltf/number.h"
#include "writers/gltf/origin.h"

namespace wrlkit::gltf {
namespace {

/// Nodes that have no counterpart and do not miss one: what they say is kept, and nothing changes for who looks.
bool harmless(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::WorldInfo) || scene.is(n, nodes::NavigationInfo) || scene.is(n, nodes::Inline) ||
         scene.type(n).is_a("X3DMetadataObject");
}

/// Groups that do something that glTF cannot do.
bool does_something(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::Anchor) || scene.is(n, nodes::Billboard);
}

Vec3 position(const Matrix& m) { return {m.m[3], m.m[7], m.m[11]}; }

/// MSFT_lod: the part of the window's height down to which each level is shown.
std::vector<double> screen_coverage(std::span<const double> range, double radius, double scale, std::size_t n_levels) {
  constexpr double half_field_of_view = 0.785398 / 2;
  std::vector<double> out;
  if (range.empty() || !(radius > 0) || !(scale > 0)) return out;
  double last = 1;
  for (std::size_t i = 0; i + 1 < n_levels; ++i) {
    double d = i < range.size() ? range[i] * scale : 0;
    double covered = d > 0 ? radius / (d * std::tan(half_field_of_view)) : 1;
    out.push_back(last = std::min(last, covered));
  }
  out.push_back(0);
  return out;
}

}  // namespace

Hierarchy::Hierarchy(const Scene& scene, const GltfOptions& options, Meshes& meshes, Materials& materials,
                     Animations& animations, Extras* extras, PartTable& parts, Diagnostics& diag)
    : scene_(scene),
      options_(options),
      meshes_(meshes),
      materials_(materials),
      animations_(animations),
      extras_(extras),
      parts_(parts),
      diag_(diag),
      visited_(scene.node_count(), 0) {}

void Hierarchy::build() {
  frames_.push_back({.node = {}, .children = scene_.main.roots});
  while (!frames_.empty()) {
    Frame& f = frames_.back();
    if (f.next == f.children.size())
      leave();
    else if (NodeId n = f.children[f.next++])
      visit(n);
  }
  add_headlight();
  move_to_origin();
  if (options_.names == GltfOptions::Names::table)
    make_part_rows();
  else if (options_.gpu_instancing)
    make_instances();
  report_lost();
}

Hierarchy::Kind Hierarchy::kind(NodeId n) {
  auto id = scene_.type_id(n).value;
  if (id >= kinds_.size()) kinds_.resize(id + 1, Kind::not_known);
  if (kinds_[id] != Kind::not_known) return kinds_[id];
  const auto& t = scene_.type(n);
  if (t.kind == NodeKind::unknown) return hierarchy_children(scene_, n).empty() ? Kind::other : Kind::group;
  return kinds_[id] = t.kind != NodeKind::builtin  ? Kind::other
                      : t.is_a("X3DGroupingNode")  ? Kind::group
                      : scene_.is(n, nodes::Shape) ? Kind::shape
                      : t.is_a("X3DViewpointNode") ? Kind::viewpoint
                      : is_light(scene_, n)        ? Kind::light
                                                   : Kind::other;
}

/// A few shared groups can stand for any number of nodes. Beyond the limit each node is shown once and no more.
bool Hierarchy::one_too_many(NodeId n) {
  if (!visited_[n.value] || nodes_.size() + frames_.size() < options_.max_nodes) return false;
  if (!full_) diag_.report(Diag::expansion_limit, scene_.where(n), options_.max_nodes, "nodes");
  return full_ = true;
}

void Hierarchy::visit(NodeId n) {
  if (one_too_many(n)) return;
  switch (kind(n)) {
    case Kind::group:
      return enter(n);
    case Kind::shape:
      built_.push_back(shape(n));
      break;
    case Kind::light:
      built_.push_back(light(n));
      break;
    case Kind::viewpoint:
      built_.push_back(viewpoint(n));
      break;
    case Kind::other:
    case Kind::not_known:
      built_.push_back(other(n));
  }
  set_same(built_.back());
}

/// Notes which node this one is once more; what lies in it need not be said.
void Hierarchy::set_same(std::uint32_t id) {
  Node& n = nodes_[id];
  auto [at, is_new] = became_.try_emplace(n.source.value, id);
  if (!is_new && !frames_.back().again) n.same_as = at->second;
}

void Hierarchy::enter(NodeId n) {
  if (first_visit(n)) report_group(n);
  Frame f{.node = n, .first_built = built_.size(), .world = frames_.back().world};
  f.again = frames_.back().again || became_.contains(n.value);
  f.children = scene_.is(n, nodes::LOD) ? hierarchy_children(scene_, n) : shown_children(scene_, n);
  if (scene_.is(n, nodes::Transform)) {
    f.local = node_transform(scene_, n);
    f.world = f.world * matrix(f.local.outer);
    if (f.local.inner) f.world = f.world * matrix(*f.local.inner);
  }
  frames_.push_back(std::move(f));
}

/// Of positions and the like: those of geometry are counted where they are stored.
void Hierarchy::report_overflow(NodeId n) {
  for (const Value& v : scene_.fields(n)) {
    const Value& c = scene_.content(v);
    if (c.is || info(c.type).element != Element::number || info(c.type).multiple || fits_float(c.number_span()))
      continue;
    diag_.report(Diag::float_overflow, scene_.where(n),
                 std::string(scene_.type(n).name) + "." + std::string(scene_.field_name(n, v)));
  }
}

void Hierarchy::report_group(NodeId n) {
  if (does_something(scene_, n)) add_lost(n);
  // Switches that no file has written only hold what prototypes leave behind.
  bool hides = scene_.is(n, nodes::Switch) && hierarchy_children(scene_, n).size() > shown_children(scene_, n).size();
  if (hides && scene_.where(n)) diag_.report(Diag::no_gltf_choice, scene_.where(n));
}

/// Texture coordinates that a rule makes from where the viewer is.
void Hierarchy::report_texcoords(NodeId geometry) {
  auto slot = scene_.type(geometry).find("texCoord", Dialect::x3d);
  const Value* v = slot ? scene_.find(geometry, *slot) : nullptr;
  if (v && !v->is && v->type == FieldType::SFNode && scene_.is(v->node, nodes::TextureCoordinateGenerator))
    diag_.report(Diag::no_gltf_value, scene_.where(v->node), scene_.type(geometry).name,
                 "texCoord (TextureCoordinateGenerator)");
}

void Hierarchy::leave() {
  Frame f = std::move(frames_.back());
  frames_.pop_back();
  if (frames_.empty()) {
    roots_ = std::move(built_);
    world_ = f.box;
    return;
  }
  auto id = group(f);
  built_.resize(f.first_built);
  if (says_nothing(nodes_[id]) && id + 1 == nodes_.size() && !scene_.is(frames_.back().node, nodes::LOD))
    return nodes_.pop_back();
  built_.push_back(id);
  set_same(id);
  Frame& parent = frames_.back();
  bool coarse_level = scene_.is(parent.node, nodes::LOD) && parent.next > 1;
  if (!coarse_level) parent.box.add(f.box);
}

std::uint32_t Hierarchy::group(const Frame& f) {
  if (auto folded = fold(f); folded != none) return folded;
  std::span<const std::uint32_t> children(built_.begin() + static_cast<std::ptrdiff_t>(f.first_built), built_.end());
  if (scene_.is(f.node, nodes::LOD) && children.size() > 1) {
    make_lod(f);
    children = children.first(1);
  }
  if (turns_about_a_center(f.node)) return turning(f, children);
  Node node{.source = f.node, .plain = f.local.plain};
  if (!f.local.inner) {
    node.transform = add_transform(f.local.outer, animations_.moves(f.node));
    auto id = add(node, children);
    add_targets(f.node, id, id, id);
    return id;
  }
  auto inner = add({.transform = add_transform(*f.local.inner)}, children);
  node.transform = add_transform(f.local.outer);
  auto id = add(node, {&inner, 1});
  add_targets(f.node, id, id, id);
  return id;
}

bool Hierarchy::turns_about_a_center(NodeId n) const {
  namespace t = nodes::transform;
  if (!scene_.is(n, nodes::Transform) || (!animations_.moves(n, Path::rotation) && !animations_.moves(n, Path::scale)))
    return false;
  return scene_.get(n, t::center) != Vec3{0, 0, 0} || !quaternion(scene_.get(n, t::scaleOrientation)).identity();
}

/// T, then C R, then SR S, then -SR -C.
std::uint32_t Hierarchy::turning(const Frame& f, std::span<const std::uint32_t> children) {
  namespace t = nodes::transform;
  const Vec3 c = scene_.get(f.node, t::center);
  const Quaternion sr = quaternion(scene_.get(f.node, t::scaleOrientation)), back = inverse(sr);
  const std::vector<std::uint32_t> below(children.begin(), children.end());
  auto helper = [&](const Trs& trs, std::span<const std::uint32_t> held) {
    return add({.transform = add_transform(trs, true)}, held);
  };
  auto last = helper(placed_at(rotate(back, {-c[0], -c[1], -c[2]}), back), below);
  auto scale = helper({{0, 0, 0}, sr, scene_.get(f.node, t::scale)}, {&last, 1});
  auto rotation = helper({c, quaternion(scene_.get(f.node, t::rotation)), {1, 1, 1}}, {&scale, 1});
  Node node{.source = f.node,
            .transform = add_transform({scene_.get(f.node, t::translation), {}, {1, 1, 1}}, true),
            .plain = false};
  auto id = add(node, {&rotation, 1});
  add_targets(f.node, id, rotation, scale);
  return id;
}

void Hierarchy::add_targets(NodeId source, std::uint32_t translation, std::uint32_t rotation, std::uint32_t scale) {
  if (!animations_.moves(source)) return;
  animations_.add_target(source, Path::translation, translation);
  animations_.add_target(source, Path::rotation, rotation);
  animations_.add_target(source, Path::scale, scale);
}

Vec3 Hierarchy::offset(std::uint32_t id) const {
  const Node& n = nodes_[id];
  if (!n.source || n.transform == none) return {0, 0, 0};
  const Vec3 field = scene_.is(n.source, nodes::Transform)   ? scene_.get(n.source, nodes::transform::translation)
                     : scene_.is(n.source, nodes::Viewpoint) ? scene_.get(n.source, nodes::viewpoint::position)
                                                             : light_transform(scene_, n.source).translation;
  const Vec3& at = transforms_[n.transform].translation;
  return {at[0] - field[0], at[1] - field[1], at[2] - field[2]};
}

/// A lone Shape without a name and with nothing of its own to say becomes the mesh of its Transform or Group.
std::uint32_t Hierarchy::fold(const Frame& f) {
  bool only_groups = scene_.is(f.node, nodes::Transform) || scene_.is(f.node, nodes::Group);
  if (!only_groups || f.local.inner || turns_about_a_center(f.node) || built_.size() != f.first_built + 1) return none;
  Node& child = nodes_[built_.back()];
  if (options_.facts_only) return fold_into(f, child);
  bool bare = child.attachment == Attachment::mesh && child.transform == none && scene_.name(child.source).empty();
  if (!bare || (extras_ && extras_->says_more(child.source, nodes::Shape))) return none;
  child.source = f.node;
  child.plain = f.local.plain;
  child.transform = add_transform(f.local.outer, animations_.moves(f.node));
  add_targets(f.node, built_.back(), built_.back(), built_.back());
  return built_.back();
}

/// A group and the one thing in it, when only one of them has a name and their transforms are one.
std::uint32_t Hierarchy::fold_into(const Frame& f, Node& child) {
  const bool drawn = child.attachment == Attachment::mesh || child.attachment == Attachment::nothing;
  if (child.source && child.attachment == Attachment::nothing && extras_ && scene_.is(child.source, nodes::Shape) &&
      extras_->has_unseen_names(child.source))
    return none;
  if (!drawn || child.lod || !child.source || animations_.moves(child.source) || animations_.moves(f.node)) return none;
  if (!scene_.name(child.source).empty() && !scene_.name(f.node).empty()) return none;
  const bool only_groups = scene_.is(child.source, nodes::Transform) || scene_.is(child.source, nodes::Group) ||
                           scene_.is(child.source, nodes::Shape);
  const Trs& outer = f.local.outer;
  const Trs inner = child.transform == none ? Trs{} : transforms_[child.transform];
  const bool even = outer.scale[0] == outer.scale[1] && outer.scale[1] == outer.scale[2];
  if (!only_groups || !(even || inner.rotation.identity())) return none;
  Trs both{matrix(outer).point(inner.translation), outer.rotation * inner.rotation, inner.scale};
  for (std::size_t i = 0; i < 3; ++i) both.scale[i] *= outer.scale[i];
  child.transform = add_transform(both);
  if (scene_.name(child.source).empty()) child.source = f.node;
  return built_.back();
}

/// Nobody would miss it: no name, nothing in it.
bool Hierarchy::says_nothing(const Node& n) const {
  const bool group = n.source && scene_.name(n.source).empty() &&
                     (scene_.type(n.source).is_a("X3DGroupingNode") || scene_.is(n.source, nodes::Shape));
  if (group && extras_ && scene_.is(n.source, nodes::Shape) && extras_->has_unseen_names(n.source)) return false;
  return options_.facts_only && group && n.n_children == 0 && n.attachment == Attachment::nothing &&
         !does_something(scene_, n.source);
}

void Hierarchy::make_lod(const Frame& f) {
  Lod lod;
  lod.levels.assign(built_.begin() + static_cast<std::ptrdiff_t>(f.first_built) + 1, built_.end());
  double scale = mean_scale(f.world);
  lod.coverage =
      screen_coverage(scene_.get(f.node, nodes::lod::range), f.box.extent() / 2, scale, lod.levels.size() + 1);
  nodes_[built_[f.first_built]].lod = true;
  lods_.emplace(built_[f.first_built], std::move(lod));
}

std::uint32_t Hierarchy::shape(NodeId n) {
  first_visit(n);
  Node node{.source = n};
  NodeId geometry_node = scene_.get(n, nodes::shape::geometry);
  if (!geometry_node) return add(node);
  NodeId appearance = scene_.get(n, nodes::shape::appearance);
  auto geometry = meshes_.geometry(geometry_node, materials_.has_picture(appearance));
  const Geometry& g = meshes_.geometries()[geometry];
  if (first_visit(geometry_node, !g.empty())) report_texcoords(geometry_node);
  if (g.empty()) return add(node);
  if (extras_) extras_->set_shown(n);
  Frame& f = frames_.back();
  meshes_.note_use(geometry, f.world);
  bool coarse_level = scene_.is(f.node, nodes::LOD) && f.next > 1;
  if (!coarse_level) f.box.add(meshes_.bounds(g, f.world));
  if (g.origin != none) node.transform = add_transform({.translation = meshes_.origins()[g.origin]});
  auto material = materials_.get(appearance, g.surface());
  node.attachment = Attachment::mesh;
  node.attached = meshes_.mesh(geometry, material);
  return add(node);
}

std::uint32_t Hierarchy::light(NodeId n) {
  Node node{.source = n,
            .transform = add_transform(light_transform(scene_, n), animations_.moves(n, Path::translation))};
  bool on = options_.lights && shines(scene_, n, animations_.motion());
  if (first_visit(n) && on) report_lost_light(scene_, n, frames_.size() == 1, diag_);
  if (on) {
    const Matrix& frame = frames_.back().world;
    node.attachment = Attachment::light;
    node.attached = static_cast<std::uint32_t>(lights_.size());
    double scale = mean_scale(frame);
    lights_.push_back(
        {n, position(frame * matrix(light_transform(scene_, n))), scale > 0 && std::isfinite(scale) ? scale : 1});
  }
  auto id = add(node);
  animations_.add_target(n, Path::translation, id);
  return id;
}

std::uint32_t Hierarchy::viewpoint(NodeId n) {
  first_visit(n);
  Node node{.source = n, .transform = add_transform(camera_transform(scene_, n), animations_.moves(n))};
  if (options_.cameras) {
    node.attachment = Attachment::camera;
    node.attached = static_cast<std::uint32_t>(cameras_.size());
    cameras_.push_back({n, position(frames_.back().world * matrix(camera_transform(scene_, n)))});
  }
  auto id = add(node);
  add_targets(n, id, id, id);
  return id;
}

std::uint32_t Hierarchy::other(NodeId n) {
  if (first_visit(n) && !harmless(scene_, n) && !animations_.motion().expressed(n)) add_lost(n);
  if (!navigation_info_ && scene_.is(n, nodes::NavigationInfo)) navigation_info_ = n;
  if (!world_info_ && scene_.is(n, nodes::WorldInfo)) world_info_ = n;
  return add({.source = n});
}

std::uint32_t Hierarchy::add(Node n, std::span<const std::uint32_t> children) {
  n.first_child = static_cast<std::uint32_t>(children_.size());
  n.n_children = static_cast<std::uint32_t>(children.size());
  children_.insert(children_.end(), children.begin(), children.end());
  nodes_.push_back(n);
  return static_cast<std::uint32_t>(nodes_.size() - 1);
}

std::uint32_t Hierarchy::add_transform(const Trs& t, bool always) {
  if (t.identity() && !always) return none;
  transforms_.push_back(t);
  return static_cast<std::uint32_t>(transforms_.size() - 1);
}

void Hierarchy::add_lost(NodeId n) {
  if (lost_.empty()) first_lost_ = scene_.where(n);
  ++lost_[scene_.type(n).name];
}

bool Hierarchy::first_visit(NodeId n, bool has_place) {
  if (visited_[n.value]) return false;
  visited_[n.value] = 1;
  report_overflow(n);
  if (extras_ && has_place) extras_->set_placed(n);
  return true;
}

// Viewers light what has no lights; where there are lights of the world's own they do not, and the headlight would be
// missed. It goes with the first camera, where a browser would be in the beginning, or looks along -Z without one;
// there is only one, because all lights of glTF shine at the same time.
void Hierarchy::add_headlight() {
  if (lights_.empty() || !visibility(scene_, navigation_info_).headlight) return;
  auto id = add({.attached = static_cast<std::uint32_t>(lights_.size()), .attachment = Attachment::light});
  lights_.push_back({});
  if (cameras_.empty()) return roots_.push_back(id);
  auto is_first = [](const Node& n) { return n.attachment == Attachment::camera && n.attached == 0; };
  Node& camera = *std::ranges::find_if(nodes_, is_first);
  camera.first_child = static_cast<std::uint32_t>(children_.size());
  camera.n_children = 1;
  children_.push_back(id);
}

/// Subtracts the origin of a world that is far away from the outermost translations: nodes that have none of their own
/// pass it on to their children, so that no node stays far away.
void Hierarchy::move_to_origin() {
  origin_ = world_origin(world_);
  if (!origin_) return;
  std::vector<std::uint32_t> open = roots_;
  while (!open.empty()) {
    auto n = open.back();
    open.pop_back();
    move(n, {-(*origin_)[0], -(*origin_)[1], -(*origin_)[2]}, open);
  }
}

void Hierarchy::move(std::uint32_t id, const Vec3& by, std::vector<std::uint32_t>& further) {
  Node& n = nodes_[id];
  if (n.lod) further.insert(further.end(), lods_.at(id).levels.begin(), lods_.at(id).levels.end());
  if (n.transform == none && n.attachment == Attachment::nothing) {
    auto c = children(n);
    further.insert(further.end(), c.begin(), c.end());
    return;
  }
  if (n.transform == none) {
    transforms_.push_back({});
    n.transform = static_cast<std::uint32_t>(transforms_.size() - 1);
  }
  auto& t = transforms_[n.transform].translation;
  for (std::size_t i = 0; i < 3; ++i) t[i] += by[i];
}

namespace {

/// Digits behind the point, as the nearest double: 0.1 + 0.2 is written 0.3.
double decimal(double v, int digits) {
  const double per_unit = std::pow(10, digits);
  return std::round(v * per_unit) / per_unit;
}

double stretch(const Trs& t) { return std::max({std::abs(t.scale[0]), std::abs(t.scale[1]), std::abs(t.scale[2])}); }

}  // namespace

Hierarchy::Family Hierarchy::family() const {
  Family f{roots_, std::vector<std::uint32_t>(nodes_.size(), none)};
  for (std::size_t i = 0; i < f.order.size(); ++i) {
    const auto id = f.order[i];
    const Node& n = nodes_[id];
    auto below = [&](std::uint32_t c, std::uint32_t p) {
      f.parent[c] = p;
      f.order.push_back(c);
    };
    for (auto c : children(n)) below(c, id);
    if (n.lod)
      for (auto l : lods_.at(id).levels) below(l, f.parent[id]);
  }
  return f;
}

std::vector<double> Hierarchy::growth(const Family& f) const {
  std::vector<double> out(nodes_.size(), 1);
  for (auto id : f.order)
    if (const auto p = f.parent[id]; p != none)
      out[id] = out[p] * (nodes_[p].transform == none ? 1 : stretch(transforms_[nodes_[p].transform]));
  return out;
}

double Hierarchy::round_transforms(double tolerance) {
  const auto [order, parent] = family();
  auto trs = [&](std::uint32_t id) { return nodes_[id].transform == none ? Trs{} : transforms_[nodes_[id].transform]; };
  std::vector<double> reach(nodes_.size(), 0);  // of what is in a node, in its frame
  for (std::size_t i = order.size(); i-- > 0;) {
    const std::uint32_t id = order[i];
    const Node& n = nodes_[id];
    if (n.attachment == Attachment::mesh && n.instances == none)
      reach[id] = std::max(reach[id], meshes_.reach(n.attached));
    if (n.instances != none)
      for (const Trs& t : instances_[n.instances].places)
        reach[id] = std::max(reach[id], std::hypot(t.translation[0], t.translation[1], t.translation[2]) +
                                            stretch(t) * meshes_.reach(n.attached));
    if (n.attachment == Attachment::camera || n.attachment == Attachment::light)
      reach[id] = std::max(reach[id], world_.extent());
    const Trs t = trs(id);
    if (parent[id] != none)
      reach[parent[id]] = std::max(
          reach[parent[id]], std::hypot(t.translation[0], t.translation[1], t.translation[2]) + stretch(t) * reach[id]);
  }
  // The fewest digits with which the sum on the way to each leaf stays below the tolerance.
  constexpr int most = 9;
  for (int digits = std::max(0, static_cast<int>(std::floor(-std::log10(tolerance)))); digits <= most; ++digits) {
    std::vector<double> moved(nodes_.size(), 0), scale(nodes_.size(), 1);
    std::vector<std::pair<std::uint32_t, Trs>> all;
    double worst = 0;
    for (std::uint32_t id : order) {
      if (parent[id] != none) {
        moved[id] = moved[parent[id]];
        scale[id] = scale[parent[id]];
      }
      if (nodes_[id].transform == none || animations_.moves(nodes_[id].source)) {
        scale[id] *= stretch(trs(id));
        continue;
      }
      const Trs t = trs(id);
      Trs r = t;
      const int turn_digits = std::clamp(
          digits + static_cast<int>(std::ceil(std::log10(std::max(2 * reach[id] * scale[id] * stretch(t), 1e-9)))), 3,
          15);
      const int place_digits =
          std::clamp(digits + static_cast<int>(std::ceil(std::log10(std::max(scale[id], 1e-9)))), 0, 15);
      for (double& v : r.translation) v = decimal(v, place_digits);
      for (double& v : r.scale) v = decimal(v, turn_digits) == 0 ? v : decimal(v, turn_digits);
      for (double* v : {&r.rotation.x, &r.rotation.y, &r.rotation.z, &r.rotation.w}) *v = decimal(*v, turn_digits);
      const Quaternion &a = t.rotation, &b = r.rotation;
      const double place = std::hypot(t.translation[0] - r.translation[0], t.translation[1] - r.translation[1],
                                      t.translation[2] - r.translation[2]);
      const double turn = 2 * std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                                        (a.z - b.z) * (a.z - b.z) + (a.w - b.w) * (a.w - b.w));
      const double grown = std::hypot(t.scale[0] - r.scale[0], t.scale[1] - r.scale[1], t.scale[2] - r.scale[2]);
      moved[id] += scale[id] * (place + (turn * stretch(t) + grown) * reach[id]);
      scale[id] *= stretch(t);
      worst = std::max(worst, moved[id]);
      all.emplace_back(id, r);
    }
    if (worst > tolerance) continue;
    for (const auto& [id, t] : all) transforms_[nodes_[id].transform] = t;
    return worst;
  }
  return 0;
}

/// In the node of the mesh where that can be; what is animated, or is a Transform that can come back, has it in a
/// child.
void Hierarchy::dequantize(const std::function<const Dequantization*(std::uint32_t)>& of_mesh) {
  for (std::uint32_t id = 0, n = static_cast<std::uint32_t>(nodes_.size()); id < n; ++id) {
    const auto* d = nodes_[id].attachment == Attachment::mesh ? of_mesh(nodes_[id].attached) : nullptr;
    if (!d) continue;
    const Vec3 step{d->step, d->step, d->step};
    const bool keeps =
        extras_ && !options_.facts_only && !(nodes_[id].source && scene_.is(nodes_[id].source, nodes::Shape));
    if (keeps || animations_.moves(nodes_[id].source)) {
      const auto child = add({.transform = add_transform({d->origin, {}, step}),
                              .attached = nodes_[id].attached,
                              .attachment = Attachment::mesh});
      nodes_[id].attachment = Attachment::nothing;
      nodes_[id].first_child = static_cast<std::uint32_t>(children_.size());
      nodes_[id].n_children = 1;
      children_.push_back(child);
      continue;
    }
    const Trs t = nodes_[id].transform == none ? Trs{} : transforms_[nodes_[id].transform];
    nodes_[id].transform = add_transform(
        {matrix(t).point(d->origin), t.rotation, {t.scale[0] * d->step, t.scale[1] * d->step, t.scale[2] * d->step}},
        true);
  }
}

/// In one message: a world may have dozens of types that glTF does not know.
void Hierarchy::report_lost() {
  std::string types;
  for (const auto& [type, n] : lost_) {
    if (!types.empty()) types += ", ";
    types += type;
    if (n > 1) types += " (" + std::to_string(n) + ")";
  }
  if (!lost_.empty()) diag_.report(Diag::no_gltf_node, first_lost_, types);
  if (auto n = scene_.main.routes.size() - animations_.motion().n_expressed_routes())
    diag_.report(Diag::no_gltf_route, {}, n);
  if (auto n = scene_.main.imports.size() + scene_.main.exports.size()) diag_.report(Diag::no_gltf_import, {}, n);
}

}  // namespace wrlkit::gltf
