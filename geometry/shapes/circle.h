// The circle behind Cone, Cylinder and Sphere.
#pragma once
#include <vector>

#include "geometry/tessellation.h"

namespace wrlkit {

/// Segments of a circle of that radius; the rule is in tessellate.h. `shown`: those of the part that a form was
/// recognised in, which an automatic tolerance keeps; 0: none.
int circle_segments(double radius, const Tessellation& options, int shown = 0);

/// Points of the unit circle in the Y = 0 plane as textures wrap around it (ISO/IEC 14772-1, 6.11): from the back (-Z)
/// counterclockwise seen from above. Point k of n is (x[k], z[k]); n + 1 points, the last equals the first.
void unit_circle(int n, std::vector<double>& x, std::vector<double>& z);

}  // namespace wrlkit
