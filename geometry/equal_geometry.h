// Geometry that is written out again: exporters repeat a bolt ten thousand times, and what is made of one holds for
// all.
#pragma once
#include <unordered_map>

#include "scenegraph/scene.h"

namespace wrlkit {

/// Sets of faces, lines and points by what they and the nodes below them say, to the last bit; DEF names and places do
/// not count. For a scene that does not change meanwhile.
class EqualGeometry {
 public:
  /// A hash of the content; 0: it is none of those types, or has values that a prototype gives. O(1), for pieces of
  /// long arrays stand for the whole.
  static std::uint64_t hash_of(const Scene&, NodeId);
  /// Whether two nodes with the same hash, which is not 0, have the same content.
  static bool same(const Scene&, NodeId, NodeId);

  explicit EqualGeometry(const Scene& scene) : scene_(scene) {}

  /// The node that was added and is equal; none, too, for nodes of other types and ones with values that a
  /// prototype gives. O(bytes of its arrays).
  NodeId find(NodeId);
  /// From now on it is found, unless one like it is already, or others had its hash.
  void add(NodeId);
  /// Spares the work of finding these out: its hash, and a node that is equal, if one is known.
  void know(NodeId n, std::uint64_t hash, NodeId same) {
    hashed_ = n;
    hash_ = hash;
    same_ = same;
  }

 private:
  std::uint64_t hash(NodeId);

  const Scene& scene_;
  std::unordered_map<std::uint64_t, NodeId> nodes_;
  NodeId hashed_, same_;  // the last one, and one known to be equal
  std::uint64_t hash_ = 0;
};

}  // namespace wrlkit
