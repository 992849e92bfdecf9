// A rotation as VRML writes it.
#pragma once
#include <cmath>

#include "base/math/matrix.h"

namespace wrlkit {

/// Axis and angle, from 0 to pi, of a matrix that only turns; 0 0 1 0 where it does not turn.
inline Vec4 axis_angle(const Matrix& r) {
  const Vec3 twice{r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  const double sine = fast_length(twice) / 2;
  const double cosine = (r(0, 0) + r(1, 1) + r(2, 2) - 1) / 2;
  const double angle = std::atan2(sine, cosine);
  if (angle < 1e-14) return {0, 0, 1, 0};
  if (sine > 1e-6) return {twice[0] / (2 * sine), twice[1] / (2 * sine), twice[2] / (2 * sine), angle};
  // Half a turn: the axis is the longest column of R + 1.
  Vec3 axis{};
  double longest = 0;
  for (int k = 0; k < 3; ++k) {
    Vec3 column{r(0, k), r(1, k), r(2, k)};
    column[static_cast<std::size_t>(k)] += 1;
    if (const double length = fast_length(column); length > longest) {
      longest = length;
      axis = column;
    }
  }
  return {axis[0] / longest, axis[1] / longest, axis[2] / longest, angle};
}

}  // namespace wrlkit
