// Which nodes are equal, so that one can replace all of them: materials, textures, geometry and what it is made
// of. What is in the hierarchy (Shapes, groups, lights) is never the same as something else: it can be pointed at.
#pragma once
#include <string_view>
#include <unordered_map>
#include <vector>

#include "passes/analysis/usage.h"

namespace wrlkit {

class Representatives {
 public:
  /// For nodes of one scope. Two are equal if they are of one type, and all fields do; nodes in their fields if one
  /// stands for both. A url is equal only below the same folder. `named`: also nodes with different DEF names.
  ///
  /// Nothing stands for nodes that events may reach (Usage::touched), nor for those with an IS or with fields that are
  /// not known. A nameless node is replaced by one with a name, if there is any: so no name is lost. O(nodes and
  /// their values), by hashing.
  Representatives(const Scene& scene, const Usage& usage, std::span<const NodeId> nodes, bool named);

  /// The first that is equal; the node itself where none does.
  NodeId of(NodeId n) const { return n && n.value < of_.size() && of_[n.value] ? of_[n.value] : n; }

 private:
  struct Class {
    NodeId first, first_named;
    std::uint32_t next;  // with the same hash
  };
  static constexpr std::uint32_t none = 0xffffffff;

  bool may_share(NodeId n) const;
  std::uint32_t height(NodeId n);
  void find(std::span<const NodeId> level);
  std::uint32_t class_of(NodeId n);
  bool is_default(NodeId n, const Value& v) const;
  std::uint64_t hash(NodeId n) const;
  std::uint64_t hash(const Value& v) const;
  bool same(NodeId a, NodeId b) const;
  bool same(const Value& a, const Value& b) const;
  std::string_view folder(NodeId n) const;

  const Scene& scene_;
  const Usage& usage_;
  bool named_;
  std::vector<std::uint32_t> height_;  // by node, plus one; 0: not one of them
  std::vector<NodeId> of_;
  std::vector<Class> classes_;
  std::unordered_map<std::uint64_t, std::uint32_t> by_hash_;
};

}  // namespace wrlkit
