// How often the nodes of a scene are shown, and some of the places of what is shown very often: no way is followed for
// it, so it is linear in the nodes however often they are used.
#pragma once
#include <cstdint>
#include <vector>

#include "base/math/matrix.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Nodes of the shown hierarchy (shown_children), children before parents, each once.
std::vector<NodeId> shown_nodes(const Scene& scene);

/// How often each node is shown; counts saturate.
std::vector<std::uint64_t> times_shown(const Scene& scene, const std::vector<NodeId>& shown);

/// The ways to each node by their numbers: any of them can be asked for without the others.
class NumberedPlaces {
 public:
  /// O(nodes). `scene` and `times`, which are of it, must outlive this.
  NumberedPlaces(const Scene& scene, const std::vector<NodeId>& shown, const std::vector<std::uint64_t>& times);

  /// From what is below the node's parents to the world, for a number below the times that the node is shown. Siblings
  /// with the same number have the same place. O(log(times) log(uses)).
  Matrix place(NodeId n, std::uint64_t number) const;

 private:
  /// A use of a node: its parent, none among the roots, and how many ways there are up to and with this one.
  struct Use {
    NodeId parent;
    std::uint64_t end;
  };
  /// Up from a node past all that are used once: from what is below its parents to what is below those of `top`.
  struct Chain {
    NodeId top;
    Matrix up{};
  };
  std::vector<std::uint32_t> first_use_;  // by node
  std::vector<Use> uses_;
  std::vector<Chain> chains_;   // by node
  std::vector<Matrix> matrix_;  // by node
};

}  // namespace wrlkit
