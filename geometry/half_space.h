// What is left of a mesh on one side of a plane.
#pragma once
#include "base/math/matrix.h"
#include "geometry/mesh.h"

namespace wrlkit {

/// The plane a x + b y + c z + d = 0 in the coordinates of what the matrix moves.
Vec4 plane_below(const Vec4& plane, const Matrix&);

/// Cuts off what lies where plane[0] x + plane[1] y + plane[2] z + plane[3] is negative: triangles, lines and points.
/// New corners have the values between those of the edge that they are on; neighbours share them. Nothing closes the
/// hole. Faces are triangles before (is_triangles) and behind. False: all of the mesh is in front, and it stays as it
/// is. O(corners * log(cut edges)), whatever the number of positions.
bool cut_by_plane(Mesh& mesh, const Vec4& plane);

}  // namespace wrlkit
