#include "passes/lightmap/witnesses.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::bake {

using drawing::V3;

Witnesses::Witnesses(const Scene& scene, const light::LightWorld& world) {
  constexpr std::uint32_t nobodys = 0xffffffff;
  const auto& stage = world.stage();
  for (const auto& v : stage.viewpoints)
    if (scene.is(v.node, nodes::Viewpoint)) all_.push_back({stage.frames[v.frame].point(V3(scene.get(v.node, nodes::viewpoint::position))), nobodys});
  for (const auto& l : world.lamps()) all_.push_back({l.light.location, nobodys});
  for (const auto& e : world.emitters()) all_.push_back({e.at(1. / 3, 1. / 3), e.use});
  std::erase_if(all_, [](const Witness& w) { return !finite(w.at); });
  std::ranges::stable_sort(all_, {}, [](const Witness& w) { return w.at.x; });
}

bool Witnesses::within(const drawing::Box& box, std::uint32_t use) const {
  for (auto w = std::ranges::lower_bound(all_, box.low.x, {}, [](const Witness& a) { return a.at.x; }); w != all_.end() && w->at.x <= box.high.x; ++w) {
    const V3& p = w->at;
    if (w->use != use && p.y >= box.low.y && p.y <= box.high.y && p.z >= box.low.z && p.z <= box.high.z) return true;
  }
  return false;
}

}  // namespace wrlkit::bake
