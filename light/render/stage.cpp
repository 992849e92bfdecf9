#include "light/render/stage.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::drawing {
namespace {

/// Transform (6.52): T C R SR S -SR -C.
Affine local_frame(const Scene& scene, NodeId n) {
  namespace f = nodes::transform;
  V3 center = scene.get(n, f::center);
  Affine turn = rotation(scene.get(n, f::rotation)), axes = rotation(scene.get(n, f::scaleOrientation));
  return translation(scene.get(n, f::translation)) * translation(center) * turn * axes *
         scaling(scene.get(n, f::scale)) * axes.inverse() * translation(-center);
}

/// Billboard (6.6) in a frame: its Z axis turns to the viewer, about the axis of rotation, or freely when that is zero.
Affine turned_to(const Pose& viewer, const V3& axis, const Affine& frame) {
  Affine inverse = frame.inverse();
  V3 to_viewer = inverse.point(viewer.eye);
  if (!finite(to_viewer)) return {};
  V3 a = unit(axis);
  if (!(dot(a, a) > 0)) {
    V3 z = unit(to_viewer), x = unit(cross(inverse.vector(viewer.up), z));
    return dot(x, x) > 0 ? Affine{x, cross(z, x), z, {}} : Affine{};
  }
  auto across = [&](const V3& v) { return v - dot(v, a) * a; };
  V3 from = across({0, 0, 1}), to = across(to_viewer);
  return rotation(a, std::atan2(dot(a, cross(from, to)), dot(from, to)));
}

class Walk {
 public:
  Walk(const Scene& scene, Diagnostics& diag, const StageOptions& options)
      : scene_(scene),
        viewer_(options.viewer),
        level_of_(options.level_of),
        diag_(diag),
        limits_(options.limits),
        ways_(scene, options.limits.visits),
        most_visits_(options.limits.visits + scene.node_count()),
        n_uses_(scene.node_count()) {
    limits_.shapes += scene.node_count();
  }

  Stage run() {
    push_children(scene_.main.roots, {0, 0, 0});
    while (const auto way = ways_.next())
      if (may_visit(way->node) && !visit(*way)) break;
    if (ways_.too_many()) report("nodes when every USE is followed", most_visits_);
    return std::move(stage_);
  }

 private:
  struct Handed {  // down to children
    std::uint32_t frame, lights, name;
  };
  using Item = Ways<Handed>::Step;

  void report(std::string_view what, std::size_t limit) { diag_.report(Diag::expansion_limit, {}, limit, what); }

  bool may_visit(NodeId n) {
    if (++n_uses_[n.value] <= limits_.uses) return true;
    if (!uses_reported_) {
      uses_reported_ = true;
      diag_.report(Diag::expansion_limit, scene_.where(n), limits_.uses, "uses of a node");
    }
    return false;
  }

  /// False when there is no room for more.
  bool visit(const Item& i) {
    TypeId t = scene_.type_id(i.node);
    std::uint32_t name = name_below(i);
    if (t == nodes::Shape) return add_shape(i, name);
    Placed here{i.node, i.state.frame};
    if (t == nodes::PointLight || t == nodes::SpotLight)
      add_light(here);
    else if (t == nodes::Viewpoint)
      stage_.viewpoints.push_back(here);
    else if (t == nodes::Background || t == nodes::TextureBackground)
      bind(stage_.background, here);
    else if (t == nodes::Fog)
      bind(stage_.fog, here);
    else if (t == nodes::NavigationInfo)
      bind(stage_.navigation, here);
    else
      push_children(shown_children(scene_, i.node, level(i)), {frame_below(i), i.state.lights, name});
    return true;
  }

  static void bind(std::optional<Placed>& slot, const Placed& p) {
    if (!slot) slot = p;
  }

  bool add_shape(const Item& i, std::uint32_t name) {
    NodeId geometry = scene_.get(i.node, nodes::shape::geometry);
    if (!geometry) return true;
    if (stage_.uses.size() == limits_.shapes) {
      report("Shapes when every USE is followed", limits_.shapes);
      return false;
    }
    stage_.uses.push_back(
        {geometry, scene_.get(i.node, nodes::shape::appearance), i.node, i.state.frame, i.state.lights, name});
    return true;
  }

  void add_light(const Placed& p) {
    if (stage_.lights.size() < limits_.lights)
      stage_.lights.push_back(p);
    else if (!lights_reported_) {
      lights_reported_ = true;
      report("lights", limits_.lights);
    }
  }

  /// The name of what stands at or below a node.
  std::uint32_t name_below(const Item& i) {
    if (scene_.name(i.node).empty()) return i.state.name;
    stage_.names.push_back({i.node, i.state.name});
    return static_cast<std::uint32_t>(stage_.names.size() - 1);
  }

  std::size_t level(const Item& i) const {
    return level_of_ && scene_.is(i.node, nodes::LOD) ? level_of_(i.node, stage_.frames[i.state.frame]) : 0;
  }

  /// The frame of the children of a node.
  std::uint32_t frame_below(const Item& i) {
    const Affine& above = stage_.frames[i.state.frame];
    if (scene_.is(i.node, nodes::Transform)) return add_frame(above * local_frame(scene_, i.node));
    if (!scene_.is(i.node, nodes::Billboard)) return i.state.frame;
    stage_.billboards = true;
    return viewer_ ? add_frame(above * turned_to(*viewer_, scene_.get(i.node, nodes::billboard::axisOfRotation), above))
                   : i.state.frame;
  }

  std::uint32_t add_frame(const Affine& a) {
    stage_.frames.push_back(a);
    return static_cast<std::uint32_t>(stage_.frames.size() - 1);
  }

  /// Children in the order of the file, under the DirectionalLights that are among them.
  void push_children(std::span<const NodeId> children, Handed below) {
    for (NodeId c : children)
      if (scene_.is(c, nodes::DirectionalLight)) below.lights = scope_with({c, below.frame}, below.lights);
    ways_.push(children, below);
  }

  std::uint32_t scope_with(const Placed& light, std::uint32_t parent) {
    std::uint32_t depth = stage_.scopes[parent].depth + 1;
    if (depth > limits_.scope_depth) {
      if (!depth_reported_) {
        depth_reported_ = true;
        report("DirectionalLights on one Shape", limits_.scope_depth);
      }
      return parent;
    }
    stage_.scopes.push_back({parent, depth, light});
    return static_cast<std::uint32_t>(stage_.scopes.size() - 1);
  }

  const Scene& scene_;
  const std::optional<Pose>& viewer_;
  const LevelOf& level_of_;
  Diagnostics& diag_;
  StageLimits limits_;
  Stage stage_;
  Ways<Handed> ways_;
  std::size_t most_visits_;
  std::vector<std::uint32_t> n_uses_;  // by node
  bool uses_reported_ = false, lights_reported_ = false, depth_reported_ = false;
};

}  // namespace

Stage set_stage(const Scene& scene, Diagnostics& diag, const StageOptions& options) {
  return Walk(scene, diag, options).run();
}

std::string full_name(const Scene& scene, const Stage& stage, const Use& use) {
  std::string out;
  for (std::uint32_t n = use.name; n; n = stage.names[n].parent)
    out = std::string(scene.name(stage.names[n].node)) + (out.empty() ? "" : "/") + out;
  return out;
}

}  // namespace wrlkit::drawing
