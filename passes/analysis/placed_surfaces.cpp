#include "passes/analysis/placed_surfaces.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

std::vector<ShapeSurface> placed_surfaces(const Scene& scene, const Usage& usage,
                                          const std::function<bool(NodeId, NodeId)>& may_change) {
  std::vector<ShapeSurface> out;
  const auto nodes = reachable(scene, scene.main);
  std::vector<std::uint32_t> held(scene.node_count()), number(scene.node_count());
  auto hold = [&](std::span<const NodeId> list) {
    for (NodeId n : list)
      if (n) ++held[n.value];
  };
  hold(scene.main.roots);
  for (NodeId n : nodes)
    if (scene.is(n, nodes::X3DGroupingNode))
      for (const Value& v : scene.fields(n))
        if (!v.is && !scene.is_extra(v) && v.type == FieldType::MFNode) hold(v.node_span());
  for (NodeId n : nodes) {
    if (!scene.is(n, nodes::Shape) || !is_plain(scene, usage, n) || held[n.value] != usage.uses(n)) continue;
    const NodeId g = scene.get(n, nodes::shape::geometry);
    if (!g || !may_change(n, g)) continue;
    auto& i = number[g.value];
    if (!i) {
      out.push_back({g, {}});
      i = static_cast<std::uint32_t>(out.size());
    }
    out[i - 1].shapes.push_back(n);
  }
  std::erase_if(out, [&](const ShapeSurface& s) { return s.shapes.size() != usage.uses(s.geometry); });
  return out;
}

}  // namespace wrlkit
