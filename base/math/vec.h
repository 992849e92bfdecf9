// Small vectors of doubles.
#pragma once
#include <array>
#include <cmath>

namespace wrlkit {

using Vec2 = std::array<double, 2>;
using Vec3 = std::array<double, 3>;
using Vec4 = std::array<double, 4>;

inline Vec3 vec3(const double* p) { return {p[0], p[1], p[2]}; }
inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Without overflow and underflow; `fast_length` is what inner loops use.
inline double length(const Vec3& a) { return std::hypot(a[0], a[1], a[2]); }
inline double fast_length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The vector with length 1; the zero vector stays as it is.
inline Vec3 unit(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? Vec3{a[0] / l, a[1] / l, a[2] / l} : a;
}

}  // namespace wrlkit
