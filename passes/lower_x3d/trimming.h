// Surfaces of two parameters from which closed lines in the plane of the parameters cut parts away.
#pragma once
#include <cstdint>
#include <vector>

#include "base/math/vec.h"
#include "passes/lower_x3d/nurbs.h"

namespace wrlkit::x3d {

struct TrimmedGrid {
  std::vector<Vec2> points;              // u and v
  std::vector<std::uint32_t> triangles;  // three a triangle, anticlockwise in u and v
};

/// What is left of a grid between contours. A point is on the surface where an odd number of contours lies around it,
/// whichever way they run; where all of the outermost run clockwise, their outside stays (ISO/IEC 19775-1, 27.4.14).
/// Cells that no contour crosses are two triangles, the others are cut along it, so that neighbours share all corners.
/// Contours without an area do not count; parts outside of the grid are drawn to its edge. Nothing where no contour
/// counts, or where they are too many: 30 million for points times lines of the grid, a
/// thousand million for points times contours. O((rows + corners of the result)
/// * log + rows * contour points + contours^2 * their points).
TrimmedGrid trim(const Grid&, const std::vector<std::vector<Vec2>>& contours);

}  // namespace wrlkit::x3d
