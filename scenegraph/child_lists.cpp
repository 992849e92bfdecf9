#include "scenegraph/child_lists.h"

#include "scenegraph/walk.h"

namespace wrlkit {

void replace_children(Scene& scene, const std::unordered_map<std::uint32_t, NodeId>& instead) {
  const auto replace = [&](std::vector<NodeId>& list) {
    for (NodeId& n : list)
      if (const auto at = n ? instead.find(n.value) : instead.end(); at != instead.end()) n = at->second;
  };
  edit_child_lists(scene, reachable(scene, scene.main), replace);
  replace(scene.main.roots);
}

}  // namespace wrlkit
