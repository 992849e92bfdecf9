// What each use of a scope needs for itself, and what all uses can share: an instance of a prototype is a use of its
// body, an Inline one of the file. Shared nodes are why a prototype that doubles itself forty times is forty nodes.
//
// A node is a scope's own when two uses of it can come to differ: when events can reach it (it is an end of a ROUTE,
// exported, a Script, below a Script, which may change what it holds, an instance of a prototype that has such nodes,
// or an Inline, whose file has not been read yet), when it has an IS, and when it holds a node of that kind.
#pragma once
#include <functional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

class OwnNodes {
 public:
  /// Has the prototype of this instance nodes that events can reach?
  using HasState = std::function<bool(NodeId instance)>;
  /// Marks the nodes below the scope's roots and below `defaults`. True when events can reach one of them. n log n.
  bool mark(const Scene&, const Scope&, std::span<const NodeId> defaults, const HasState&);
  bool operator[](NodeId n) const { return n.value < own_.size() && own_[n.value]; }

 private:
  std::vector<char> met_, own_;
};

/// The nodes of one use of a scope: copies of its own nodes, and all others themselves.
class Copies {
 public:
  Copies(Scene& scene, const OwnNodes& own) : scene_(scene), own_(own) {}
  /// `to` stands for `n`.
  void put(NodeId n, NodeId to) { copies_[n.value] = to; }
  NodeId of(NodeId n);
  Value of(const Value&);
  /// The next copy that has no fields yet, and what it is made from; false when there is none.
  bool next(NodeId& from, NodeId& to);

 private:
  Scene& scene_;
  const OwnNodes& own_;
  std::unordered_map<std::uint32_t, NodeId> copies_;
  std::vector<std::pair<NodeId, NodeId>> made_;
  std::size_t n_filled_ = 0;
};

/// What copying a node takes: a node with long lists counts for several.
std::size_t cost_of_copy(const Scene&, NodeId);

}  // namespace wrlkit
