// What is asked of affine maps: the way back, and where directions go.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/math/matrix.h"

namespace wrlkit {

/// A direction through a map; what the map moves by does not count.
inline Vec3 direction(const Matrix& m, const Vec3& v) {
  return {m(0, 0) * v[0] + m(0, 1) * v[1] + m(0, 2) * v[2], m(1, 0) * v[0] + m(1, 1) * v[1] + m(1, 2) * v[2],
          m(2, 0) * v[0] + m(2, 1) * v[1] + m(2, 2) * v[2]};
}

/// Whether lengths do not vanish in it.
inline bool is_invertible(const Matrix& m) {
  double size = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) size = std::max(size, std::abs(m(r, c)));
  return std::isfinite(size) && std::abs(m.determinant()) > 1e-12 * size * size * size;
}

/// Its adjugate by its determinant; the identity when the determinant is zero or not finite.
inline Matrix inverse(const Matrix& m) {
  const double d = m.determinant();
  if (!(std::abs(d) > 0) || !std::isfinite(d)) return {};
  const Vec3 x = m.column(0), y = m.column(1), z = m.column(2), r0 = cross(y, z), r1 = cross(z, x), r2 = cross(x, y);
  const Vec3 a{r0[0] / d, r1[0] / d, r2[0] / d}, b{r0[1] / d, r1[1] / d, r2[1] / d}, c{r0[2] / d, r1[2] / d, r2[2] / d};
  const Vec3 t = matrix_of_columns(a, b, c).point(m.column(3));
  return matrix_of_columns(a, b, c, {-t[0], -t[1], -t[2]});
}

}  // namespace wrlkit
