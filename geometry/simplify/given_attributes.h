// What a level shows that was made of positions alone: the attributes of the surface that it stands for.
#pragma once
#include "geometry/closest_point.h"
#include "geometry/mesh.h"

namespace wrlkit::simplify {

class GivenAttributes {
 public:
  /// Of a mesh of triangles, which must outlive this. O(n log n).
  explicit GivenAttributes(const Mesh& part);

  /// Gives each corner of a level in the same coordinates what the part has there, of the attributes that the level
  /// lacks. Normals are of length 1, and on the side of their faces. O(corners log n).
  void give(Mesh& level) const;

 private:
  std::uint32_t behind(const std::array<Vec3, 3>& face, std::size_t corner, std::uint32_t guess) const;

  const Mesh& part_;
  Triangles surface_;
  ClosestPoint nearest_;
};

/// Normals to three decimals, equal ones shared; none where all corners have those of their faces: a crease angle of 0
/// says the same. For a mesh of triangles.
void shorten_normals(Mesh& mesh);

}  // namespace wrlkit::simplify
