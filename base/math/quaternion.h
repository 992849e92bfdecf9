// Rotations as unit quaternions, and what becomes of them as axis and angle or as a matrix.
#pragma once
#include <cmath>

#include "base/math/matrix.h"

namespace wrlkit {

struct Quaternion {
  double x = 0, y = 0, z = 0, w = 1;

  bool identity() const { return x == 0 && y == 0 && z == 0; }
};

inline Quaternion operator-(const Quaternion& q) { return {-q.x, -q.y, -q.z, -q.w}; }
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
inline Quaternion inverse(const Quaternion& q) { return {-q.x, -q.y, -q.z, q.w}; }
inline double dot(const Quaternion& a, const Quaternion& b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }

/// About an axis of any length; none when that is zero or not finite.
inline Quaternion quaternion_of(const Vec4& axis_angle) {
  const double length = std::hypot(axis_angle[0], axis_angle[1], axis_angle[2]);
  if (!(length > 0) || !std::isfinite(length)) return {};
  const double s = std::sin(axis_angle[3] / 2) / length;
  return {axis_angle[0] * s, axis_angle[1] * s, axis_angle[2] * s, std::cos(axis_angle[3] / 2)};
}

/// Of a matrix that only turns. The largest part is found first: nothing is divided by a small number.
inline Quaternion quaternion_of_matrix(const Matrix& m) {
  const double x = m(0, 0), y = m(1, 1), z = m(2, 2);
  const Vec3 twice_axis{m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1)};
  const double xy = m(0, 1) + m(1, 0), xz = m(0, 2) + m(2, 0), yz = m(1, 2) + m(2, 1);
  Quaternion q{1 + x - y - z, xy, xz, twice_axis[0]};
  if (x + y + z > 0)
    q = {twice_axis[0], twice_axis[1], twice_axis[2], 1 + x + y + z};
  else if (y > x && y >= z)
    q = {xy, 1 - x + y - z, yz, twice_axis[1]};
  else if (z > x)
    q = {xz, yz, 1 - x - y + z, twice_axis[2]};
  const double length = std::sqrt(dot(q, q));
  return {q.x / length, q.y / length, q.z / length, q.w / length};
}

/// Axis and angle, from 0 to pi, as VRML writes a rotation; 0 0 1 0 where nothing turns. A quaternion of any length.
inline Vec4 axis_angle(Quaternion q) {
  const double n = std::hypot(q.x, q.y, q.z);
  if (!(n > 0) || !std::isfinite(n)) return {0, 0, 1, 0};
  if (q.w < 0) q = -q;
  return {q.x / n, q.y / n, q.z / n, 2 * std::atan2(n, q.w)};
}

/// The same of a matrix that only turns, where what rounding leaves does not count as a turn.
inline Vec4 axis_angle(const Matrix& m) {
  const Quaternion q = quaternion_of_matrix(m);
  return std::hypot(q.x, q.y, q.z) < 5e-15 ? Vec4{0, 0, 1, 0} : axis_angle(q);
}

inline Matrix matrix_of(const Quaternion& q) {
  const double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z, xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
  const double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
  return {{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy), 0,  //
           2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx), 0,  //
           2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy), 0}};
}

/// From a to b at a constant speed, along the way given by the signs of the two.
inline Quaternion slerp(const Quaternion& a, const Quaternion& b, double t) {
  const double angle = std::acos(std::fmin(std::fmax(dot(a, b), -1.0), 1.0)), s = std::sin(angle);
  const double wa = s > 1e-9 ? std::sin((1 - t) * angle) / s : 1 - t, wb = s > 1e-9 ? std::sin(t * angle) / s : t;
  return {wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z, wa * a.w + wb * b.w};
}

}  // namespace wrlkit
