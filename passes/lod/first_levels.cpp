#include "passes/lod/first_levels.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "geometry/simplify/surfaces.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// Nodes that a ROUTE ends at or that a Script holds.
std::vector<char> nodes_of_events(const Scene& scene) {
  std::vector<char> out(scene.node_count());
  for_each_route(scene, [&](const Route& r) { out[r.from.value] = out[r.to.value] = 1; });
  for (const NodeId n : all_nodes(scene))
    if (scene.type(n).kind == NodeKind::script) for_each_child(scene, n, [&](NodeId c) { out[c.value] = 1; });
  return out;
}

bool is_drawn(const Scene& scene, NodeId level) {
  return std::ranges::any_of(reachable(scene, std::array{level}), [&](NodeId n) { return scene.is(n, nodes::Shape); });
}

/// Whether nothing but forms is lost with some levels.
class Levels {
 public:
  explicit Levels(const Scene& scene) : scene_(scene), has_events_(nodes_of_events(scene)) {}

  bool has_events(NodeId n) const { return has_events_[n.value] != 0; }

  bool are_forms(std::span<const NodeId> levels) const {
    const auto all = reachable(scene_, levels);
    std::vector<NodeId> shapes;
    std::ranges::copy_if(all, std::back_inserter(shapes), [&](NodeId n) { return scene_.is(n, nodes::Shape); });
    std::vector<char> is_of_shape(scene_.node_count());
    for (const NodeId n : reachable(scene_, shapes)) is_of_shape[n.value] = 1;
    return std::ranges::all_of(
        all, [&](NodeId n) { return !has_events(n) && (is_of_shape[n.value] || groups(n) || is_empty_info(n)); });
  }

 private:
  bool groups(NodeId n) const {
    return scene_.is(n, nodes::Group) || scene_.is(n, nodes::Transform) || scene_.is(n, nodes::Billboard) ||
           scene_.is(n, nodes::Collision) || scene_.is(n, nodes::Switch) || scene_.is(n, nodes::LOD);
  }
  /// What many exporters write for a level in which nothing is drawn.
  bool is_empty_info(NodeId n) const { return scene_.is(n, nodes::WorldInfo) && scene_.fields(n).empty(); }

  const Scene& scene_;
  std::vector<char> has_events_;
};

}  // namespace

std::size_t keep_first_levels(Scene& scene) {
  std::vector<NodeId> cut;
  const Levels all(scene);
  for (const NodeId lod : all_nodes(scene)) {
    if (!scene.is(lod, nodes::LOD) || all.has_events(lod) || !has_coarser_level(scene, lod)) continue;
    const auto levels = scene.get(lod, nodes::lod::children);
    if (is_drawn(scene, levels[0]) && all.are_forms(std::span(levels).subspan(1))) cut.push_back(lod);
  }
  for (const NodeId lod : cut) {
    const NodeId first = scene.get(lod, nodes::lod::children)[0];
    scene.set(lod, nodes::lod::children, std::vector<NodeId>{first});
    scene.set(lod, nodes::lod::range, std::vector<double>{});
  }
  return cut.size();
}

}  // namespace wrlkit
