// The flat ends of Cone and Cylinder.
#pragma once
#include <span>

#include "geometry/shapes/face_writer.h"

namespace wrlkit {

/// Where a cap is: the circle as unit_circle gives it, and the positions of its points, consecutive from `first`.
struct Cap {
  std::span<const double> x, z;
  std::uint32_t first;
  bool up;
};

/// One n-gon with the circle cut out of the texture square (ISO/IEC 14772-1, 6.14). Seen from outside, +X is right in
/// the picture; up is -Z on an upper cap and +Z on a lower one, which is how each stands when it is tilted to the
/// viewer.
void write_cap(FaceWriter& out, const Cap& cap);

}  // namespace wrlkit
