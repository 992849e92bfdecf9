#include "scenegraph/driven.h"

#include <algorithm>

#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scopes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

bool is_geometry(const Scene& scene, NodeId n) { return scene.is(n, nodes::X3DGeometryNode); }

std::vector<char> driven_geometry(const Scene& scene) {
  std::vector<char> driven(scene.node_count());
  for_each_scope(scene, [&](const Scope& s) {
    for (const auto& r : s.routes) driven[r.from.value] = driven[r.to.value] = 1;
    for (const auto& e : s.exports) driven[e.node.value] = 1;
  });
  const auto takes_values = [&](NodeId n) {
    return std::ranges::any_of(scene.fields(n), [&](const Value& v) { return scene.content(v).is; });
  };
  const auto is_script = [&](NodeId n) { return scene.type(n).kind == NodeKind::script; };
  const bool none = std::ranges::find(driven, 1) == driven.end();
  if (none && !any_node(scene, [&](NodeId n) { return takes_values(n) || is_script(n); })) return driven;
  const auto nodes = all_nodes(scene);
  for (const NodeId n : nodes) {
    if (takes_values(n)) driven[n.value] = 1;
    if (is_script(n)) for_each_child(scene, n, [&](NodeId c) { driven[c.value] = 1; });
  }
  for (const NodeId n : nodes)
    if (is_geometry(scene, n)) for_each_child(scene, n, [&](NodeId c) { driven[n.value] |= driven[c.value]; });
  return driven;
}

}  // namespace wrlkit
