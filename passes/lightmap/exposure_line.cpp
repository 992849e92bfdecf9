#include "passes/lightmap/exposure_line.h"

#include <algorithm>
#include <string>
#include <vector>

#include "light/exposure.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {

void keep_exposure(Scene& scene, double factor) {
  constexpr std::string_view start = "lightmap exposure ";
  const auto nodes = reachable(scene, scene.main);
  const auto found = std::ranges::find_if(nodes, [&](NodeId n) { return scene.is(n, nodes::WorldInfo); });
  const NodeId info = found != nodes.end() ? *found : scene.add(nodes::WorldInfo);
  if (found == nodes.end()) scene.main.roots.push_back(info);
  std::vector<std::string> lines;
  for (const std::string_view line : scene.get(info, nodes::world_info::info))
    if (!line.starts_with(start)) lines.emplace_back(line);
  lines.push_back(std::string(start) + Exposure{.factor = factor}.print());
  scene.set(info, nodes::world_info::info, std::vector<std::string_view>(lines.begin(), lines.end()));
}

}  // namespace wrlkit::bake
