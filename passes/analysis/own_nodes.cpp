#include "passes/analysis/own_nodes.h"

#include <algorithm>

#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

struct Edge {
  NodeId child, parent;
};

/// Everything that hangs on one of `open` in the direction that `neighbours(node, visit)` leads to.
template <class Neighbours>
void spread(std::vector<NodeId> open, std::vector<char>& marks, Neighbours neighbours) {
  for (NodeId n : open) marks[n.value] = 1;
  while (!open.empty()) {
    NodeId n = open.back();
    open.pop_back();
    neighbours(n, [&](NodeId m) {
      if (!std::exchange(marks[m.value], 1)) open.push_back(m);
    });
  }
}

}  // namespace

bool OwnNodes::mark(const Scene& scene, const Scope& scope, std::span<const NodeId> defaults,
                    const HasState& has_state) {
  std::vector<NodeId> nodes, acting, varying;
  reach(scene, scope.roots, met_, nodes);
  reach(scene, defaults, met_, nodes);
  own_.resize(met_.size());
  std::vector<Edge> edges;
  for (NodeId n : nodes) {
    const auto& type = scene.type(n);
    if (type.name == "Script" || type.name == "Inline" || (type.kind == NodeKind::proto && has_state(n)))
      acting.push_back(n);
    if (std::ranges::any_of(scene.fields(n), [&](const Value& v) { return scene.content(v).is; })) varying.push_back(n);
    for_each_child(scene, n, [&](NodeId c) { edges.push_back({c, n}); });
  }
  for (const Route& r : scope.routes) {
    varying.push_back(r.from);
    varying.push_back(r.to);
  }
  for (const Import& i : scope.imports) {
    varying.push_back(i.inline_node);
    varying.push_back(i.node);
  }
  for (const Export& e : scope.exports) varying.push_back(e.node);
  const bool state = !acting.empty() || !scope.routes.empty() || !scope.exports.empty();

  // Down from Scripts, then up from all. A child may have been met, and marked, with another scope.
  spread(acting, own_, [&](NodeId n, auto visit) { for_each_child(scene, n, visit); });
  for (const Edge& e : edges)
    if (own_[e.child.value]) varying.push_back(e.child);
  std::ranges::sort(edges, {}, &Edge::child);
  spread(varying, own_, [&](NodeId n, auto visit) {
    for (auto e = std::ranges::lower_bound(edges, n, {}, &Edge::child); e != edges.end() && e->child == n; ++e)
      visit(e->parent);
  });
  return state;
}

NodeId Copies::of(NodeId n) {
  if (auto known = copies_.find(n.value); known != copies_.end()) return known->second;
  if (!n || !own_[n]) return n;
  NodeId to = scene_.add(scene_.type_id(n), scene_.where(n));
  scene_.set_name(to, scene_.name(n));
  copies_.emplace(n.value, to);
  made_.emplace_back(n, to);
  return to;
}

Value Copies::of(const Value& v) {
  const Value& content = scene_.content(v);
  if (content.is || info(content.type).element != Element::node) return v;
  std::vector<NodeId> to;
  for (NodeId c : content.node_span()) to.push_back(of(c));
  if (std::ranges::equal(to, content.node_span())) return v;
  bool list = info(content.type).multiple;
  Value copy = list ? scene_.make(content.type, v.slot, to) : scene_.make(content.type, v.slot, to[0]);
  return scene_.is_extra(v) ? scene_.make_extra(v.extra->name, copy) : copy;
}

bool Copies::next(NodeId& from, NodeId& to) {
  if (n_filled_ == made_.size()) return false;
  std::tie(from, to) = made_[n_filled_++];
  return true;
}

std::size_t cost_of_copy(const Scene& scene, NodeId n) {
  constexpr std::size_t values_a_node = 8;
  std::size_t values = scene.fields(n).size();
  for_each_child(scene, n, [&](NodeId) { ++values; });
  return 1 + values / values_a_node;
}

}  // namespace wrlkit
