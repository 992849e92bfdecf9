// The matrix of a Transform (ISO/IEC 14772-1, 6.52) and what is done with such matrices. Column vectors; the last row is
// 0 0 0 1 and not stored.
#pragma once
#include <array>
#include <cmath>

#include "scenegraph/nodes.h"
#include "scenegraph/scene.h"

namespace wrlkit {

struct Matrix {
  std::array<double, 12> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};  // three rows of four

  double operator()(int r, int c) const { return m[static_cast<std::size_t>(r * 4 + c)]; }
  double& operator()(int r, int c) { return m[static_cast<std::size_t>(r * 4 + c)]; }
  Vec3 point(const Vec3& p) const {
    return {m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3], m[4] * p[0] + m[5] * p[1] + m[6] * p[2] + m[7],
            m[8] * p[0] + m[9] * p[1] + m[10] * p[2] + m[11]};
  }
  double determinant() const {
    return m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
  }
  bool operator==(const Matrix&) const = default;
};

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix o;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) o(r, c) = a(r, 0) * b(0, c) + a(r, 1) * b(1, c) + a(r, 2) * b(2, c) + (c == 3 ? a(r, 3) : 0);
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
  double length = std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
  if (!(length > 0) || !std::isfinite(length)) return {};
  double x = r[0] / length, y = r[1] / length, z = r[2] / length, c = std::cos(r[3]), s = std::sin(r[3]), d = 1 - c;
  Matrix o;
  o.m = {x * x * d + c, x * y * d - z * s, x * z * d + y * s, 0, x * y * d + z * s, y * y * d + c, y * z * d - x * s, 0, x * z * d - y * s, y * z * d + x * s, z * z * d + c, 0};
  return o;
}

/// What a Transform node says.
struct TransformFields {
  Vec3 translation{0, 0, 0};
  Vec4 rotation{0, 0, 1, 0};
  Vec3 scale{1, 1, 1};
  Vec4 scale_orientation{0, 0, 1, 0};
  Vec3 center{0, 0, 0};
  bool operator==(const TransformFields&) const = default;
};

/// T C R SR S -SR -C.
inline Matrix matrix_of(const TransformFields& f) {
  const auto &t = f.translation, &c = f.center;
  const auto& o = f.scale_orientation;
  Matrix linear = rotation_matrix(f.rotation);
  if (f.scale != Vec3{1, 1, 1}) linear = linear * rotation_matrix(o) * scale_matrix(f.scale) * rotation_matrix({o[0], o[1], o[2], -o[3]});
  if (c == Vec3{0, 0, 0}) return translation_matrix(t) * linear;
  return translation_matrix({t[0] + c[0], t[1] + c[1], t[2] + c[2]}) * linear * translation_matrix({-c[0], -c[1], -c[2]});
}

/// Of a Transform node; identity for other nodes.
inline Matrix local_matrix(const Scene& scene, NodeId n) {
  namespace f = nodes::transform;
  if (!scene.is(n, nodes::Transform)) return {};
  return matrix_of({scene.get(n, f::translation), scene.get(n, f::rotation), scene.get(n, f::scale), scene.get(n, f::scaleOrientation), scene.get(n, f::center)});
}

}  // namespace wrlkit
