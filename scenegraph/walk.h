// Going through a scene: which nodes a node holds, and in what order they are met.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

/// Calls f(NodeId) for each node that a field of `n` holds, in the order of its fields; unknown fields too. NULL in a
/// list is no node.
template <class F>
void for_each_child(const Scene& scene, NodeId n, F&& f) {
  for (const Value& v : scene.fields(n))
    for (NodeId c : scene.content(v).node_span())
      if (c) f(c);
}

/// Appends every node that can be reached from `roots` and is not in `seen` yet, parents before children, and marks it
/// there: a walk through one scope after another meets each node once. `seen` grows with the scene.
void reach(const Scene&, std::span<const NodeId> roots, std::vector<char>& seen, std::vector<NodeId>& out);
/// Every node that can be reached from `roots`, each once, parents before children (depth first, in the order of the
/// file). The bodies of prototypes are scopes of their own. No recursion: any depth.
std::vector<NodeId> reachable(const Scene&, std::span<const NodeId> roots);
std::vector<NodeId> reachable(const Scene&, const Scope&);
/// The same over all scopes of the scene: the main one, prototypes, and the defaults in their interfaces.
std::vector<NodeId> all_nodes(const Scene&);

/// Fields that hold children in the sense of the transformation hierarchy (ISO/IEC 14772-1, 4.3.4): `children` of
/// grouping nodes, choice, level; for unknown nodes every field with nodes. Script and Sensor references do not count.
std::vector<NodeId> hierarchy_children(const Scene&, NodeId);
/// Those of them that a browser would show: the chosen child of Switch, of LOD that level or its last, not the proxy of
/// Collision.
std::vector<NodeId> shown_children(const Scene&, NodeId, std::size_t level = 0);

}  // namespace wrlkit
