#include "passes/lightmap/witnesses.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::bake {

using drawing::V3;

namespace {

/// Around the corners of the box in its own frame.
drawing::Box box_in_world(const light::LightWorld& world, std::uint32_t use) {
  const drawing::Box& own = world.meshes()[world.mesh_of()[use]].box;
  const auto& frame = world.stage().frames[world.stage().uses[use].frame];
  drawing::Box out;
  for (int k = 0; k < 8; ++k)
    out.add(frame.point(
        V3(k & 1 ? own.high.x : own.low.x, k & 2 ? own.high.y : own.low.y, k & 4 ? own.high.z : own.low.z)));
  return out;
}

bool contains(const drawing::Box& box, const V3& p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y && p.z >= box.low.z &&
         p.z <= box.high.z;
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
    const drawing::Box box = box_in_world(world, u);
    if (finite(box.low) && finite(box.high)) things_.push_back({box, u});
  }
  std::ranges::stable_sort(things_, {}, [](const Thing& t) { return t.box.low.x; });
}

bool Witnesses::within(const drawing::Box& box, std::uint32_t use) const {
  for (auto w = std::ranges::lower_bound(all_, box.low.x, {}, [](const Witness& a) { return a.at.x; });
       w != all_.end() && w->at.x <= box.high.x; ++w)
    if (w->use != use && contains(box, w->at)) return true;
  return false;
}

bool Witnesses::holds_another(const drawing::Box& box, std::uint32_t use) const {
  for (auto t = std::ranges::lower_bound(things_, box.low.x, {}, [](const Thing& a) { return a.box.low.x; });
       t != things_.end() && t->box.low.x <= box.high.x; ++t)
    if (t->use != use && contains(box, t->box.low) && contains(box, t->box.high)) return true;
  return false;
}

}  // namespace wrlkit::bake
