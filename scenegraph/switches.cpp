#include "scenegraph/switches.h"

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

bool is_switch(const Scene& scene, NodeId n) { return scene.is(n, nodes::Switch) || scene.is(n, nodes::vrml1::Switch); }

std::vector<NodeId> switch_children(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Switch)) return hierarchy_children(scene, n);
  std::vector<NodeId> out;
  for_each_child(scene, n, [&](NodeId c) { out.push_back(c); });
  return out;
}

std::vector<NodeId> shown_of_switch(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Switch)) return shown_children(scene, n);
  auto all = switch_children(scene, n);
  const auto which = scene.get(n, nodes::vrml1::switch_::whichChild);
  if (which < -1) return all;
  if (which < 0 || static_cast<std::size_t>(which) >= all.size()) return {};
  return {all[static_cast<std::size_t>(which)]};
}

bool is_switched_off(const Scene& scene, NodeId n) { return is_switch(scene, n) && shown_of_switch(scene, n).empty(); }

}  // namespace wrlkit
