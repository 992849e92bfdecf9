// Ways from the root of a scene to its nodes. A node has as many as it is used, and there may be far more ways than
// nodes: forty groups, each holding the next one twice. So all callers that follow them do so within one limit.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

constexpr std::size_t most_visits = 4'000'000;  // beyond the nodes of the scene: without USE it is always seen whole

/// Depth first, in the order of the file; a node comes with what was handed down to it. The caller pushes what it wants
/// to see below a node, so there is no recursion and any depth will do.
template <class State>
class Ways {
 public:
  struct Step {
    NodeId node;
    State state;
  };

  explicit Ways(const Scene& scene, std::size_t most = most_visits) : left_(most + scene.node_count()) {}

  void push(NodeId node, const State& state) {
    if (node) open_.push_back({node, state});
  }
  /// The first is met first.
  void push(std::span<const NodeId> nodes, const State& state) {
    for (auto n = nodes.rbegin(); n != nodes.rend(); ++n) push(*n, state);
  }
  /// None at the end, or when there were too many.
  std::optional<Step> next() {
    if (open_.empty() || too_many_) return {};
    if (left_ == 0) {
      too_many_ = true;
      return {};
    }
    --left_;
    Step step = open_.back();
    open_.pop_back();
    return step;
  }
  bool too_many() const { return too_many_; }

 private:
  std::size_t left_;
  bool too_many_ = false;
  std::vector<Step> open_;
};

}  // namespace wrlkit
