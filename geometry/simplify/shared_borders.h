// Where open borders of several parts of a scene meet. What lies there must stay where it is while each part is
// simplified for itself, or there were cracks between them, and between different levels of detail.
#pragma once
#include "geometry/simplify/surface_scales.h"

namespace wrlkit {

class SharedBorders {
 public:
  /// The mesh of the next surface, of triangles or empty. O(corners).
  void add(const Mesh& mesh);

  /// Of each of the surfaces that were added: the positions of its mesh, ascending, that lie on an open border and
  /// where another part, or another place of the same one, has such a position too. A part is a Shape where it stands
  /// in the world; positions are the same when they differ by a millionth of how far they are from the origin, or a
  /// little more. O(n log n) in the positions on borders in all places.
  std::vector<std::vector<std::uint32_t>> find(const Scene& scene, std::span<const ShapeSurface> surfaces) const;

 private:
  std::vector<std::uint32_t> position_;  // on open borders, of all surfaces
  std::vector<Vec3> point_;
  std::vector<std::size_t> end_;  // of the entries of each surface
  StampedMap local_;
  std::vector<std::uint32_t> used_;
  std::vector<std::uint64_t> open_;
};

}  // namespace wrlkit
