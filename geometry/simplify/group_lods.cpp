#include "geometry/simplify/group_lods.h"

#include <algorithm>
#include <unordered_map>

#include "base/math/saturating.h"
#include "scenegraph/child_lists.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"
#include "scenegraph/places/times_shown.h"
#include "scenegraph/transform.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

class GroupLodMaker {
 public:
  GroupLodMaker(Scene& scene, std::span<const LeveledSurface> surfaces, const LodLimits& limits)
      : scene_(scene), surfaces_(surfaces), limits_(limits) {}

  LodCounts run() {
    find_routed();
    shown_ = shown_nodes(scene_);
    nodes_.resize(scene_.node_count());
    for (auto& s : surfaces_)
      for (NodeId shape : s.surface.shapes) nodes_[shape.value].surface = &s;
    for (NodeId n : shown_) measure(n);
    for (NodeId n : choose_groups()) add_lod(n);
    replace_children(scene_, lod_of_);
    return made_;
  }

 private:
  /// What lies at and below a node, in the coordinates of its parent.
  struct Below {
    const LeveledSurface* surface = nullptr;
    bool is_open = false;    // may be copied
    bool is_inside = false;  // of a group that has a LOD
    std::uint64_t n_shapes = 0;
    Box bounds{};
    std::vector<LodLevel> levels{};  // empty where nothing changes
  };

  void find_routed() {
    routed_.resize(scene_.node_count());
    for (const auto& r : scene_.main.routes) routed_[r.from.value] = routed_[r.to.value] = 1;
  }

  bool is_routed(NodeId n) const { return n.value < routed_.size() && routed_[n.value] != 0; }
  bool is_group(NodeId n) const { return scene_.is(n, nodes::X3DGroupingNode) && !scene_.is(n, nodes::LOD); }

  std::size_t n_levels() const { return surfaces_.empty() ? 0 : surfaces_[0].levels.size(); }

  /// Its children are measured already.
  void measure(NodeId n) {
    auto& here = nodes_[n.value];
    if (is_routed(n)) return;
    if (here.surface) return measure_shape(n, here);
    if (!is_group(n)) return;
    here.is_open = true;
    const Matrix m = local_matrix(scene_, n);
    const double scale = scale_of(m);
    for (NodeId c : shown_children(scene_, n)) {
      if (!c || nodes_[c.value].levels.empty()) continue;
      const auto& child = nodes_[c.value];
      here.n_shapes = saturating_add(here.n_shapes, child.n_shapes);
      for (int i = 0; i < 8; ++i) here.bounds.add(m.point(child.bounds.corner(i)));
      here.levels.resize(n_levels());
      for (std::size_t k = 0; k < n_levels(); ++k) {
        here.levels[k].error = std::max(here.levels[k].error, scale * child.levels[k].error);
        here.levels[k].n_faces = saturating_add(here.levels[k].n_faces, child.levels[k].n_faces);
      }
    }
    for (std::size_t k = 0; k < here.levels.size(); ++k) here.levels[k].node = k == 0 ? n : copy_of_group(n, k);
  }

  void measure_shape(NodeId shape, Below& here) {
    here.is_open = true;
    here.n_shapes = 1;
    here.bounds = here.surface->bounds;
    NodeId before = here.surface->surface.geometry, copy = shape;
    for (const auto& level : here.surface->levels) {
      if (level.geometry != before) copy = level.geometry ? copy_of_shape(shape, level.geometry) : NodeId{};
      before = level.geometry;
      here.levels.push_back({copy, level.error, level.n_faces});
    }
  }

  NodeId copy_of_shape(NodeId shape, NodeId geometry) {
    const NodeId copy = copy_of(shape);
    scene_.set(copy, nodes::shape::geometry, geometry);
    return copy;
  }

  NodeId copy_of(NodeId n) {
    const auto fields = scene_.copy_of_fields(n);
    const NodeId copy = scene_.add(scene_.type_id(n), scene_.where(n));
    scene_.set_fields(copy, fields);
    return copy;
  }

  NodeId at_level(NodeId child, std::size_t k) const {
    const bool changes = child && child.value < nodes_.size() && !nodes_[child.value].levels.empty();
    return changes ? nodes_[child.value].levels[k].node : child;
  }

  /// The copy of the level before, or the group itself, where nothing has changed since; none when nothing is left.
  NodeId copy_of_group(NodeId n, std::size_t k) {
    const auto children = hierarchy_children(scene_, n);
    const NodeId before = nodes_[n.value].levels[k - 1].node;
    if (std::ranges::all_of(children, [&](NodeId c) { return at_level(c, k) == at_level(c, k - 1); })) return before;
    const NodeId copy = copy_of(n);
    const bool by_number = scene_.is(n, nodes::Switch);
    bool is_empty = true;
    edit_child_lists(scene_, {&copy, 1}, [&](std::vector<NodeId>& list) {
      for (NodeId& c : list) {
        const bool was_there = c != NodeId{};
        c = scene_.is(c, nodes::X3DBindableNode) ? NodeId{} : at_level(c, k);
        is_empty &= !c;
        if (!c && by_number && was_there) c = scene_.add(nodes::Group, scene_.where(n));
      }
      if (!by_number) std::erase(list, NodeId{});
    });
    return is_empty ? NodeId{} : copy;
  }

  /// The innermost ones that hold several Shapes, and what is outside of them.
  std::vector<NodeId> choose_groups() {
    std::vector<char> holds_several(nodes_.size());  // below
    for (NodeId n : shown_)
      for (NodeId c : shown_children(scene_, n))
        if (c) holds_several[n.value] |= holds_several[c.value] | (nodes_[c.value].n_shapes > 1);
    std::vector<NodeId> chosen;
    for (auto n = shown_.rbegin(); n != shown_.rend(); ++n) {  // parents before children
      auto& here = nodes_[n->value];
      const bool is_chosen = !here.is_inside && !here.levels.empty() && !holds_several[n->value];
      if (is_chosen) chosen.push_back(*n);
      for (NodeId c : shown_children(scene_, *n))
        if (c) nodes_[c.value].is_inside |= is_chosen || here.is_inside;
    }
    return chosen;
  }

  void add_lod(NodeId n) {
    const auto& here = nodes_[n.value];
    if (const NodeId lod = make_lod(scene_, here.bounds, here.levels, limits_, made_)) lod_of_[n.value] = lod;
  }

  Scene& scene_;
  std::span<const LeveledSurface> surfaces_;
  const LodLimits& limits_;
  std::vector<NodeId> shown_;  // children before parents
  std::vector<char> routed_;   // by node
  std::vector<Below> nodes_;   // by node
  std::unordered_map<std::uint32_t, NodeId> lod_of_;
  LodCounts made_;
};

}  // namespace

LodCounts add_group_lods(Scene& scene, std::span<const LeveledSurface> surfaces, const LodLimits& limits) {
  return GroupLodMaker(scene, surfaces, limits).run();
}

}  // namespace wrlkit
