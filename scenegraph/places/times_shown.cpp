#include "scenegraph/places/times_shown.h"

#include <algorithm>
#include <utility>

#include "base/math/saturating.h"
#include "scenegraph/transform.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// Calls f(parent, child) for each use of a node, where the parent is none for a root. All uses of a node come before
/// those that it makes of others.
template <class F>
void for_each_use(const Scene& scene, const std::vector<NodeId>& shown, F f) {
  for (NodeId n : scene.main.roots)
    if (n) f(NodeId{}, n);
  for (auto n = shown.rbegin(); n != shown.rend(); ++n)
    for (NodeId c : shown_children(scene, *n))
      if (c) f(*n, c);
}

}  // namespace

std::vector<NodeId> shown_nodes(const Scene& scene) {
  std::vector<NodeId> out;
  std::vector<char> state(scene.node_count());
  std::vector<std::pair<NodeId, bool>> stack;
  for (auto r = scene.main.roots.rbegin(); r != scene.main.roots.rend(); ++r) stack.emplace_back(*r, false);
  while (!stack.empty()) {
    auto [n, done] = stack.back();
    stack.pop_back();
    if (done) {
      out.push_back(n);
      continue;
    }
    if (!n || std::exchange(state[n.value], 1)) continue;
    stack.emplace_back(n, true);
    for (NodeId c : shown_children(scene, n)) stack.emplace_back(c, false);
  }
  return out;
}

std::vector<std::uint64_t> times_shown(const Scene& scene, const std::vector<NodeId>& shown) {
  std::vector<std::uint64_t> times(scene.node_count());
  for_each_use(scene, shown, [&](NodeId parent, NodeId child) {
    times[child.value] = saturating_add(times[child.value], parent ? times[parent.value] : 1);
  });
  return times;
}

NumberedPlaces::NumberedPlaces(const Scene& scene, const std::vector<NodeId>& shown,
                               const std::vector<std::uint64_t>& times)
    : first_use_(scene.node_count() + std::size_t{1}), chains_(scene.node_count()), matrix_(scene.node_count()) {
  for_each_use(scene, shown, [&](NodeId, NodeId child) { ++first_use_[child.value + std::size_t{1}]; });
  for (std::size_t i = 1; i < first_use_.size(); ++i) first_use_[i] += first_use_[i - 1];
  uses_.resize(first_use_.back());
  std::vector<std::uint32_t> next(first_use_.begin(), first_use_.end() - 1);
  for_each_use(scene, shown, [&](NodeId parent, NodeId child) {
    auto& at = next[child.value];
    const std::uint64_t before = at > first_use_[child.value] ? uses_[at - 1].end : 0;
    uses_[at++] = {parent, saturating_add(before, parent ? times[parent.value] : 1)};
  });
  for (auto n = shown.rbegin(); n != shown.rend(); ++n) {  // parents before children
    matrix_[n->value] = local_matrix(scene, *n);
    auto& chain = chains_[n->value];
    const auto first = first_use_[n->value];
    const NodeId parent = uses_[first].parent;
    const bool is_used_once = first_use_[n->value + std::size_t{1}] - first == 1;
    chain.top = *n;
    if (!is_used_once || !parent) continue;
    const auto& above = chains_[parent.value];
    chain = {above.top, above.up * matrix_[parent.value]};
  }
}

Matrix NumberedPlaces::place(NodeId n, std::uint64_t number) const {
  Matrix out;
  while (n) {
    const auto& chain = chains_[n.value];
    out = chain.up * out;
    n = chain.top;
    const auto first = uses_.begin() + first_use_[n.value], end = uses_.begin() + first_use_[n.value + std::size_t{1}];
    const auto use = std::upper_bound(first, end, number, [](std::uint64_t i, const Use& u) { return i < u.end; });
    if (use == end) break;
    if (use != first) number -= std::prev(use)->end;
    n = use->parent;
    if (n) out = matrix_[n.value] * out;
  }
  return out;
}

}  // namespace wrlkit
