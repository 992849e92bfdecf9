#include "passes/lightmap/witnesses.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::bake {

using drawing::V3;

namespace {

/// Around the corners of the box in its own frame.
Box box_in_world(const light::LightWorld& world, std::uint32_t use) {
  const Box& own = world.meshes()[world.mesh_of()[use]].box;
  const auto& frame = world.stage().frames[world.stage().uses[use].frame];
  Box out;
  for (int k = 0; k < 8; ++k) out.add(frame.point(own.corner(k)));
  return out;
}

bool contains(const Box& box, const V3& p) {
  return p.x >= box.low[0] && p.x <= box.high[0] && p.y >= box.low[1] && p.y <= box.high[1] && p.z >= box.low[2] &&
         p.z <= box.high[2];
}

}  // namespace

Witnesses::Witnesses(const Scene& scene, const light::LightWorld& world) {
  constexpr std::uint32_t nobodys = 0xffffffff;
  const auto& stage = world.stage();
  for (const auto& v : stage.viewpoints)
    if (scene.is(v.node, nodes::Viewpoint))
      all_.push_back({stage.frames[v.frame].point(V3(scene.get(v.node, nodes::viewpoint::position))), nobodys});
  for (const auto& l : world.lamps()) all_.push_back({l.light.location, nobodys});
  for (const auto& e : world.emitters()) all_.push_back({e.at(1. / 3, 1. / 3), e.use});
  std::erase_if(all_, [](const Witness& w) { return !finite(w.at); });
  std::ranges::stable_sort(all_, {}, [](const Witness& w) { return w.at.x; });
  for (std::uint32_t u = 0; u < stage.uses.size(); ++u) {
    const Box box = box_in_world(world, u);
    if (drawing::finite(box.low) && drawing::finite(box.high)) things_.push_back({box, u});
  }
  std::ranges::stable_sort(things_, {}, [](const Thing& t) { return t.box.low[0]; });
}

bool Witnesses::within(const Box& box, std::uint32_t use) const {
  for (auto w = std::ranges::lower_bound(all_, box.low[0], {}, [](const Witness& a) { return a.at.x; });
       w != all_.end() && w->at.x <= box.high[0]; ++w)
    if (w->use != use && contains(box, w->at)) return true;
  return false;
}

bool Witnesses::holds_another(const Box& box, std::uint32_t use) const {
  for (auto t = std::ranges::lower_bound(things_, box.low[0], {}, [](const Thing& a) { return a.box.low[0]; });
       t != things_.end() && t->box.low[0] <= box.high[0]; ++t)
    if (t->use != use && contains(box, t->box.low) && contains(box, t->box.high)) return true;
  return false;
}

}  // namespace wrlkit::bake
