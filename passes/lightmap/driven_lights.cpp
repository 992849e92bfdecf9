#include "passes/lightmap/driven_lights.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit::bake {
namespace {

/// A light node, or a Material that shines as lamps do (docs/lighting.md, "No light at all").
bool is_lamp(const Scene& scene, NodeId n) {
  constexpr double least = 0.5;
  if (scene.is(n, nodes::X3DLightNode)) return true;
  return scene.is(n, nodes::Material) && std::ranges::max(scene.get(n, nodes::material::emissiveColor)) >= least;
}

/// By node: whether it is a light or holds one.
std::vector<char> holds_light(const Scene& scene) {
  std::vector<std::pair<NodeId, NodeId>> held;  // by whom
  std::vector<char> out(scene.node_count());
  std::vector<NodeId> open;
  for (const NodeId n : reachable(scene, scene.main)) {
    for_each_child(scene, n, [&](NodeId c) {
      if (c) held.emplace_back(c, n);
    });
    if (!is_lamp(scene, n)) continue;
    out[n.value] = 1;
    open.push_back(n);
  }
  if (open.empty()) return out;
  const auto child = [](const auto& pair) { return pair.first.value; };
  std::ranges::sort(held, {}, child);
  while (!open.empty()) {
    const NodeId n = open.back();
    open.pop_back();
    for (auto at = std::ranges::lower_bound(held, n.value, {}, child); at != held.end() && at->first == n; ++at)
      if (!std::exchange(out[at->second.value], 1)) open.push_back(at->second);
  }
  return out;
}

}  // namespace

void report_driven_lights(const Scene& scene, Diagnostics& diag) {
  if (scene.main.routes.empty()) return;
  const auto is_lighting = holds_light(scene);
  std::set<std::pair<std::uint32_t, std::string_view>> reported;
  for (const Route& r : scene.main.routes) {
    const bool is_kind = scene.is(r.to, nodes::X3DLightNode) || scene.is(r.to, nodes::X3DGroupingNode);
    if (!is_kind || !is_lighting[r.to.value]) continue;
    const auto field = r.event_in.starts_with("set_") ? r.event_in.substr(4) : r.event_in;
    if (reported.emplace(r.to.value, field).second)
      diag.report(Diag::animation_baked, scene.where(r.to), scene.type(r.to).name, field);
  }
}

}  // namespace wrlkit::bake
