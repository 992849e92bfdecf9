#include "scenegraph/driven.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

bool is_geometry(const Scene& scene, NodeId n) { return scene.is(n, nodes::X3DGeometryNode); }

std::vector<char> driven_geometry(const Scene& scene) {
  std::vector<char> driven(scene.node_count());
  const auto ends = [&](const Scope& s) {
    for (const auto& r : s.routes) driven[r.from.value] = driven[r.to.value] = 1;
    for (const auto& e : s.exports) driven[e.node.value] = 1;
  };
  ends(scene.main);
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i) ends(scene.proto(ProtoId{i}).body);
  const auto nodes = all_nodes(scene);
  for (const NodeId n : nodes) {
    if (std::ranges::any_of(scene.fields(n), [&](const Value& v) { return scene.content(v).is; })) driven[n.value] = 1;
    if (scene.type(n).kind == NodeKind::script) for_each_child(scene, n, [&](NodeId c) { driven[c.value] = 1; });
  }
  for (const NodeId n : nodes)
    if (is_geometry(scene, n)) for_each_child(scene, n, [&](NodeId c) { driven[n.value] |= driven[c.value]; });
  return driven;
}

}  // namespace wrlkit
