// Nodes in the places of others, in the lists of children that hold them.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "scenegraph/nodes.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Calls f(std::vector<NodeId>&) for each list of nodes in a field of the grouping nodes among `nodes`; a list that f
/// changes is stored. Fields with an IS are left out.
template <class F>
void edit_child_lists(Scene& scene, std::span<const NodeId> nodes, F&& f) {
  for (NodeId n : nodes) {
    if (!scene.is(n, nodes::X3DGroupingNode)) continue;
    for (const Value& v : scene.copy_of_fields(n)) {
      if (v.type != FieldType::MFNode || v.is || scene.is_extra(v)) continue;
      std::vector<NodeId> list(v.node_span().begin(), v.node_span().end());
      f(list);
      if (!std::ranges::equal(list, v.node_span())) scene.set(n, scene.make(FieldType::MFNode, v.slot, list));
    }
  }
}

/// Puts nodes in the places of others (by NodeId) in all lists of children of the main scope, its roots included.
/// O(nodes).
void replace_children(Scene& scene, const std::unordered_map<std::uint32_t, NodeId>& instead);

}  // namespace wrlkit
