// Rotations as unit quaternions.
#pragma once
#include <cmath>

#include "base/math/vec.h"

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

/// From a to b at a constant speed, along the way given by the signs of the two.
inline Quaternion slerp(const Quaternion& a, const Quaternion& b, double t) {
  const double angle = std::acos(std::fmin(std::fmax(dot(a, b), -1.0), 1.0)), s = std::sin(angle);
  const double wa = s > 1e-9 ? std::sin((1 - t) * angle) / s : 1 - t, wb = s > 1e-9 ? std::sin(t * angle) / s : t;
  return {wa * a.x + wb * b.x, wa * a.y + wb * b.y, wa * a.z + wb * b.z, wa * a.w + wb * b.w};
}

}  // namespace wrlkit
