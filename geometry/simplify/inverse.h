// The way back through an affine map.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/math/matrix.h"

namespace wrlkit::simplify {

/// Whether lengths do not vanish in it.
inline bool is_invertible(const Matrix& m) {
  double size = 0;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) size = std::max(size, std::abs(m(r, c)));
  return std::isfinite(size) && std::abs(m.determinant()) > 1e-12 * size * size * size;
}

/// Of an invertible map: its adjugate by its determinant.
inline Matrix inverse(const Matrix& m) {
  Matrix out;
  const double d = 1 / m.determinant();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const int r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
      out(r, c) = d * (m(r1, c1) * m(r2, c2) - m(r1, c2) * m(r2, c1));
    }
  for (int r = 0; r < 3; ++r) {
    out(r, 3) = 0;
    for (int c = 0; c < 3; ++c) out(r, 3) -= out(r, c) * m(c, 3);
  }
  return out;
}

}  // namespace wrlkit::simplify
