// What holds what one looks for, anywhere below it in the transformation hierarchy.
#pragma once
#include <algorithm>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// By node: whether it is one, or one of its children holds one. `is_one(node)` is asked once of each node that the
/// roots lead to by `children(node)`, of children before their parents. No recursion: any depth.
template <class Children, class IsOne>
std::vector<char> holders(const Scene& scene, Children&& children_of, IsOne&& is_one) {
  std::vector<char> state(scene.node_count()), holds(scene.node_count());  // state 1: its children are being seen to
  std::vector<NodeId> stack(scene.main.roots.begin(), scene.main.roots.end());
  while (!stack.empty()) {
    const NodeId n = stack.back();
    if (!n || state[n.value] == 2) {
      stack.pop_back();
      continue;
    }
    const auto children = children_of(n);
    if (state[n.value] == 0) {
      state[n.value] = 1;
      for (NodeId c : children)
        if (c && !state[c.value]) stack.push_back(c);
      continue;
    }
    holds[n.value] = is_one(n) || std::ranges::any_of(children, [&](NodeId c) { return c && holds[c.value]; });
    state[n.value] = 2;
    stack.pop_back();
  }
  return holds;
}

}  // namespace wrlkit::bake
