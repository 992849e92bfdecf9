#include "passes/analysis/figures.h"

#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"
#include "scenegraph/walk.h"

namespace wrlkit {

SceneFigures figures_of(const Scene& scene) {
  SceneFigures f;
  std::vector<char> drawn(scene.node_count());
  for_each_place(scene, Shown::now, [&](NodeId shape, const Matrix&) {
    const NodeId g = scene.get(shape, nodes::shape::geometry);
    if (!g) return;
    ++f.draws;
    if (!drawn[g.value]) {
      drawn[g.value] = 1;
      ++f.meshes;
    }
  });
  f.nodes = reachable(scene, scene.main).size();
  return f;
}

void count_figures(PassContext& ctx, std::string_view pass, const SceneFigures& before, const SceneFigures& after) {
  auto count = [&](std::string_view what, std::uint64_t b, std::uint64_t a) {
    const std::string name = std::string(pass) + "." + std::string(what);
    ctx.stats[name + "-before"] += b;
    ctx.stats[name + "-after"] += a;
  };
  count("draws", before.draws, after.draws);
  count("nodes", before.nodes, after.nodes);
  count("meshes", before.meshes, after.meshes);
}

}  // namespace wrlkit
