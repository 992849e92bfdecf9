// What of a scene never moves by itself, and may be sorted into cells: a tree of groups that only put things together.
#pragma once
#include <vector>

#include "passes/analysis/usage.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// A way to a node. The children of a group follow it.
struct StillNode {
  enum class Kind : std::uint8_t {
    group,  // may be taken apart
    atom,   // is drawn, and stays whole
    fixed,  // is not drawn, or may move, or nobody knows what it draws
  };
  NodeId node;  // none: the world
  std::uint32_t above = 0, end = 0;
  Kind kind = Kind::group;
};

class StillTree {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  /// Of a scene with at most as many ways as may be followed (places/ways.h). O(nodes and places).
  StillTree(const Scene& scene, const Usage& usage);

  /// The world is the first; nodes come before those below them.
  const std::vector<StillNode>& nodes() const { return nodes_; }
  /// Of each place of NamedPlaces, the atom that it is in; none: it is fixed.
  const std::vector<std::uint32_t>& atom_of_place() const { return atom_of_place_; }

 private:
  StillNode::Kind kind_of(NodeId n);
  bool is_still(NodeId n);
  bool has_effect(NodeId n) const;

  const Scene& scene_;
  const Usage& usage_;
  std::vector<char> known_;  // by node, of is_still
  std::vector<StillNode> nodes_;
  std::vector<std::uint32_t> atom_of_place_;
};

/// The part of a scene that is made of some of the leaves of a tree: groups of which not all is taken are copied, and a
/// group that is taken whole stays itself. Returns the nodes below the world.
std::vector<NodeId> part_of_tree(Scene& scene, const StillTree& tree, std::span<const std::uint32_t> leaves);

}  // namespace wrlkit
