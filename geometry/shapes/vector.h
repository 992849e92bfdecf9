// The little vector algebra that the makers need.
#pragma once
#include <cmath>

#include "scenegraph/value.h"

namespace wrlkit {

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }
/// Of length 1; the zero vector stays as it is.
inline Vec3 unit(const Vec3& a) {
  double l = length(a);
  return l > 0 ? Vec3{a[0] / l, a[1] / l, a[2] / l} : a;
}

}  // namespace wrlkit
