#include "passes/lod/first_levels.h"

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

std::size_t keep_first_levels(Scene& scene) {
  std::size_t n = 0;
  for (const NodeId lod : all_nodes(scene)) {
    if (!scene.is(lod, nodes::LOD)) continue;
    const auto levels = scene.get(lod, nodes::lod::children);
    if (levels.size() < 2) continue;
    scene.set(lod, nodes::lod::children, std::vector<NodeId>{levels[0]});
    scene.set(lod, nodes::lod::range, std::vector<double>{});
    ++n;
  }
  return n;
}

}  // namespace wrlkit
