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

inline Matrix translation_matrix(const Vec3& t) {
  Matrix o;
  for (int i = 0; i < 3; ++i) o(i, 3) = t[static_cast<std::size_t>(i)];
  return o;
}

inline Matrix scale_matrix(const Vec3& s) {
  Matrix o;
  for (int i = 0; i < 3; ++i) o(i, i) = s[static_cast<std::size_t>(i)];
  return o;
}

/// Axis and angle; an axis without length turns nothing.
inline Matrix rotation_matrix(const Vec4& r) {
  const double length = fast_length({r[0], r[1], r[2]});
  if (!(length > 0) || !std::isfinite(length)) return {};
  double x = r[0] / length, y = r[1] / length, z = r[2] / length, c = std::cos(r[3]), s = std::sin(r[3]), d = 1 - c;
  Matrix o;
  o.m = {x * x * d + c,     x * y * d - z * s, x * z * d + y * s, 0,
         x * y * d + z * s, y * y * d + c,     y * z * d - x * s, 0,
         x * z * d - y * s, y * z * d + x * s, z * z * d + c,     0};
  return o;
}

}  // namespace wrlkit
