#include "passes/lod/first_levels.h"

#include <algorithm>
#include <span>
#include <vector>

#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

namespace {

/// Of nodes that may be removed with the levels that they are in, those are not.
std::vector<char> kept_nodes(const Scene& scene) {
  std::vector<char> out(scene.node_count());
  for_each_route(scene, [&](const Route& r) { out[r.from.value] = out[r.to.value] = 1; });
  return out;
}

bool is_bound_or_acts(const Scene& scene, NodeId n) {
  return scene.type(n).kind == NodeKind::script || scene.is(n, nodes::X3DBindableNode) ||
         scene.is(n, nodes::X3DLightNode);
}

}  // namespace

std::size_t keep_first_levels(Scene& scene) {
  std::size_t n = 0;
  const auto is_kept = kept_nodes(scene);
  for (const NodeId lod : all_nodes(scene)) {
    if (!scene.is(lod, nodes::LOD)) continue;
    const auto levels = scene.get(lod, nodes::lod::children);
    if (levels.size() < 2) continue;
    const auto below = reachable(scene, std::span(levels).subspan(1));
    if (std::ranges::any_of(below, [&](NodeId i) { return is_kept[i.value] || is_bound_or_acts(scene, i); })) continue;
    scene.set(lod, nodes::lod::children, std::vector<NodeId>{levels[0]});
    scene.set(lod, nodes::lod::range, std::vector<double>{});
    ++n;
  }
  return n;
}

}  // namespace wrlkit
