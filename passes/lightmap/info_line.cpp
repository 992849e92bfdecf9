#include "passes/lightmap/info_line.h"

#include <algorithm>
#include <string>
#include <vector>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {

void keep_in_info(Scene& scene, std::string_view name, std::string_view value) {
  const std::string start = "lightmap " + std::string(name) + " ";
  const auto nodes = reachable(scene, scene.main);
  const auto found = std::ranges::find_if(nodes, [&](NodeId n) { return scene.is(n, nodes::WorldInfo); });
  const NodeId info = found != nodes.end() ? *found : scene.add(nodes::WorldInfo);
  if (found == nodes.end()) scene.main.roots.push_back(info);
  std::vector<std::string> lines;
  for (const std::string_view line : scene.get(info, nodes::world_info::info))
    if (!line.starts_with(start)) lines.emplace_back(line);
  lines.push_back(start + std::string(value));
  scene.set(info, nodes::world_info::info, std::vector<std::string_view>(lines.begin(), lines.end()));
}

}  // namespace wrlkit::bake
