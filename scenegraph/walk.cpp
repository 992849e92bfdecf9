#include "scenegraph/walk.h"

#include <algorithm>
#include <utility>

#include "scenegraph/nodes.h"

namespace wrlkit {

// The children are put on the stack from the last to the first. Types of nodes are asked for directly: everything else
// that a node holds is passed over, in every pass, for every node of a plant.
void reach(const Scene& scene, std::span<const NodeId> roots, std::vector<char>& seen, std::vector<NodeId>& out) {
  if (seen.size() < scene.node_count()) seen.resize(scene.node_count() + scene.node_count() / 2);
  std::vector<NodeId> stack(roots.rbegin(), roots.rend());
  const auto push = [&](NodeId child) {
    if (child && !seen[child.value]) stack.push_back(child);
  };
  while (!stack.empty()) {
    NodeId n = stack.back();
    stack.pop_back();
    if (!n || std::exchange(seen[n.value], 1)) continue;
    out.push_back(n);
    const auto fields = scene.fields(n);
    for (auto f = fields.rbegin(); f != fields.rend(); ++f) {
      const Value& v = scene.content(*f);
      if (v.is) continue;
      if (v.type == FieldType::SFNode)
        push(v.node);
      else if (v.type == FieldType::MFNode)
        for (std::size_t i = v.count; i > 0; --i) push(v.nodes[i - 1]);
    }
  }
}

std::vector<NodeId> reachable(const Scene& scene, std::span<const NodeId> roots) {
  std::vector<char> seen;
  std::vector<NodeId> out;
  reach(scene, roots, seen, out);
  return out;
}

std::vector<NodeId> reachable(const Scene& scene, const Scope& scope) { return reachable(scene, scope.roots); }

std::vector<NodeId> all_nodes(const Scene& scene) {
  std::vector<char> seen;
  std::vector<NodeId> out;
  reach(scene, scene.main.roots, seen, out);
  for (std::uint32_t i = 0; i < scene.proto_count(); ++i) {
    const auto& p = scene.proto(ProtoId{i});
    for (const auto& f : scene.type(p.type).fields) reach(scene, f.default_value.node_span(), seen, out);
    reach(scene, p.body.roots, seen, out);
  }
  return out;
}

std::vector<NodeId> hierarchy_children(const Scene& scene, NodeId n) {
  std::vector<NodeId> out;
  const auto& t = scene.type(n);
  if (t.kind == NodeKind::script) return out;
  for (const Value& v : scene.fields(n)) {
    const Value& c = scene.content(v);
    if (c.is || info(c.type).element != Element::node) continue;
    bool holds = t.kind == NodeKind::unknown || (!scene.is_extra(v) && t.fields[v.slot].name == "children");
    if (holds) out.insert(out.end(), c.node_span().begin(), c.node_span().end());
  }
  return out;
}

std::vector<NodeId> shown_children(const Scene& scene, NodeId n, std::size_t level) {
  auto all = hierarchy_children(scene, n);
  if (scene.is(n, nodes::Switch)) {
    auto which = scene.get(n, nodes::switch_::whichChoice);
    if (which < 0 || static_cast<std::size_t>(which) >= all.size()) return {};
    return {all[static_cast<std::size_t>(which)]};
  }
  if (scene.is(n, nodes::LOD) && all.size() > 1) return {all[std::min(level, all.size() - 1)]};
  return all;
}

}  // namespace wrlkit
