#include "passes/analysis/usage.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

Usage::Usage(const Scene& scene) : uses_(scene.node_count()), touched_(scene.node_count()) {
  std::vector<NodeId> writable;
  for (NodeId n : all_nodes(scene)) {
    const auto kind = scene.type(n).kind;
    const Value* direct = kind == NodeKind::script ? scene.find(n, nodes::script::directOutput.slot) : nullptr;
    const bool writes = kind == NodeKind::proto || (direct && (direct->is || direct->integer != 0));
    for_each_child(scene, n, [&](NodeId c) {
      ++uses_[c.value];
      if (kind == NodeKind::script || kind == NodeKind::proto) touched_[c.value] = 1;
      if (writes) writable.push_back(c);
    });
  }
  add(scene.main);
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i) {
    const Proto& p = scene.proto(ProtoId{i});
    add(p.body);
    for (const auto& f : scene.type(p.type).fields)
      for (NodeId n : f.default_value.node_span()) {
        touched_[n.value] = 1;
        writable.push_back(n);
      }
  }
  for (NodeId n : reachable(scene, writable)) touched_[n.value] = 1;
}

void Usage::add(const Scope& s) {
  for (NodeId n : s.roots)
    if (n) ++uses_[n.value];
  for (const Route& r : s.routes) touched_[r.from.value] = touched_[r.to.value] = 1;
  for (const Import& i : s.imports) touched_[i.inline_node.value] = 1;
  for (const Export& e : s.exports) touched_[e.node.value] = 1;
}

bool is_plain(const Scene& scene, const Usage& usage, NodeId n) {
  return scene.type(n).kind == NodeKind::builtin && !usage.touched(n) &&
         std::ranges::none_of(scene.fields(n), [&](const Value& v) { return v.is || scene.is_extra(v); });
}

bool holds_together(const Scene& scene, const Usage& usage, NodeId n) {
  if (!scene.is(n, nodes::Group) && !scene.is(n, nodes::Transform) && !scene.is(n, nodes::StaticGroup)) return true;
  if (!is_plain(scene, usage, n)) return true;
  bool together = false;
  for_each_child(scene, n, [&](NodeId c) {
    const auto& t = scene.type(c);
    together |= t.is_a(nodes::X3DSensorNode) || scene.is(c, nodes::DirectionalLight) || scene.is(c, nodes::ClipPlane);
  });
  return together;
}

}  // namespace wrlkit
