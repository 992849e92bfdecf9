// Affine maps. Column vectors; the last row is 0 0 0 1 and not stored.
#pragma once
#include <array>
#include <cmath>

#include "base/math/vec.h"

namespace wrlkit {

struct Matrix {
  std::array<double, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // three rows of four

  double operator()(int r, int c) const { return m[static_cast<std::size_t>(r * 4 + c)]; }
  double& operator()(int r, int c) { return m[static_cast<std::size_t>(r * 4 + c)]; }
  Vec3 point(const Vec3& p) const {
    return {m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3], m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
            m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11]};
  }
  Vec3 column(int c) const { return {(*this)(0, c), (*this)(1, c), (*this)(2, c)}; }
  double determinant() const {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
           m[2] * (m[4] * m[9] - m[5] * m[8]);
  }
  bool operator==(const Matrix&) const = default;
};

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix o;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c)
      o(r, c) = a(r, 0) * b(0, c) + a(r, 1) * b(1, c) + a(r, 2) * b(2, c) + (c == 3 ? a(r, 3) : 0);
  return o;
}

/// `t` is where the origin goes.
inline Matrix matrix_of_columns(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& t = {}) {
  return {{x[0], y[0], z[0], t[0], x[1], y[1], z[1], t[1], x[2], y[2], z[2], t[2]}};
}
/// Of the 16 numbers of a matrix, column by column. Its last row does not count.
template <class T>
Matrix matrix_of_columns(const T* n) {
  return {{n[0], n[4], n[8], n[12], n[1], n[5], n[9], n[13], n[2], n[6], n[10], n[14]}};
}

inline Matrix translation_matrix(const Vec3& t) { return {{1, 0, 0, t[0], 0, 1, 0, t[1], 0, 0, 1, t[2]}}; }

inline Matrix scale_matrix(const Vec3& s) { return {{s[0], 0, 0, 0, 0, s[1], 0, 0, 0, 0, s[2], 0}}; }

/// Axis and angle; an axis without length turns nothing.
inline Matrix rotation_matrix(const Vec4& r) {
  const double length = fast_length({r[0], r[1], r[2]});
  if (!(length > 0) || !std::isfinite(length)) return {};
  double x = r[0] / length, y = r[1] / length, z = r[2] / length, c = std::cos(r[3]), s = std::sin(r[3]), d = 1 - c;
  return {{x * x * d + c, x * y * d - z * s, x * z * d + y * s, 0,  //
           x * y * d + z * s, y * y * d + c, y * z * d - x * s, 0,  //
           x * z * d - y * s, y * z * d + x * s, z * z * d + c, 0}};
}

}  // namespace wrlkit
