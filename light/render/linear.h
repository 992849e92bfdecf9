// Points, directions and affine maps of the renderer, in double: coordinates of a plant may lie a thousand kilometres
// from the origin, and what goes to single precision is first brought near it.
//
// V3 and Affine are not Vec3 and Matrix: colours are V3, too, and multiply component by component; and maps by columns
// make directions and normals of flat and mirrored frames plain sums. Boxes are those of base/math.
#pragma once
#include <cmath>

#include "base/image/srgb.h"
#include "base/math/box.h"
#include "scenegraph/value.h"

namespace wrlkit::drawing {

/// A point, a direction or a colour.
struct V3 {
  double x = 0, y = 0, z = 0;

  constexpr V3() = default;
  constexpr V3(double a, double b, double c) : x(a), y(b), z(c) {}
  constexpr explicit V3(double all) : x(all), y(all), z(all) {}
  constexpr V3(const Vec3& v) : x(v[0]), y(v[1]), z(v[2]) {}
  constexpr operator Vec3() const { return {x, y, z}; }

  V3& operator+=(const V3& b) {
    x += b.x;
    y += b.y;
    z += b.z;
    return *this;
  }
};

inline V3 operator+(const V3& a, const V3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline V3 operator-(const V3& a, const V3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline V3 operator-(const V3& a) { return {-a.x, -a.y, -a.z}; }
inline V3 operator*(double s, const V3& a) { return {s * a.x, s * a.y, s * a.z}; }
/// Component by component: colours.
inline V3 operator*(const V3& a, const V3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline double dot(const V3& a, const V3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline V3 cross(const V3& a, const V3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const V3& a) { return std::sqrt(dot(a, a)); }
inline V3 unit(const V3& a) {
  double l = length(a);
  return l > 0 ? (1 / l) * a : a;
}
inline bool finite(const V3& a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }
inline V3 mix(const V3& a, const V3& b, double t) { return (1 - t) * a + t * b; }
inline V3 min(const V3& a, const V3& b) { return {std::fmin(a.x, b.x), std::fmin(a.y, b.y), std::fmin(a.z, b.z)}; }
inline V3 max(const V3& a, const V3& b) { return {std::fmax(a.x, b.x), std::fmax(a.y, b.y), std::fmax(a.z, b.z)}; }

inline V3 to_linear(const V3& c) { return {srgb_to_linear(c.x), srgb_to_linear(c.y), srgb_to_linear(c.z)}; }
inline V3 to_srgb(const V3& c) { return {linear_to_srgb(c.x), linear_to_srgb(c.y), linear_to_srgb(c.z)}; }

/// x, y and z are the columns, t is the translation: point(p) = p.x * x + p.y * y + p.z * z + t.
struct Affine {
  V3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, t;

  V3 vector(const V3& v) const { return v.x * x + v.y * y + v.z * z; }
  V3 point(const V3& p) const { return vector(p) + t; }
  double determinant() const { return dot(x, cross(y, z)); }
  /// A normal, by the inverse transpose, not of length 1. It stays on its side of the surface when the map mirrors, and
  /// is good for maps that flatten, too.
  V3 normal(const V3& n) const {
    V3 m = n.x * cross(y, z) + n.y * cross(z, x) + n.z * cross(x, y);
    return determinant() < 0 ? -m : m;
  }
  /// Flat maps have none; what comes out then is not finite.
  Affine inverse() const {
    double d = 1 / determinant();
    V3 a = d * cross(y, z), b = d * cross(z, x), c = d * cross(x, y);
    Affine i{{a.x, b.x, c.x}, {a.y, b.y, c.y}, {a.z, b.z, c.z}, {}};
    i.t = -i.vector(t);
    return i;
  }
};

inline Affine operator*(const Affine& a, const Affine& b) {
  return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.t)};
}
inline bool finite(const Affine& a) { return finite(a.x) && finite(a.y) && finite(a.z) && finite(a.t); }

inline Affine translation(const V3& t) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, t}; }
inline Affine scaling(const V3& s) { return {{s.x, 0, 0}, {0, s.y, 0}, {0, 0, s.z}, {}}; }
/// About an axis of any length by an angle, as SFRotation has it; no rotation when the axis is zero.
inline Affine rotation(const V3& axis, double angle) {
  V3 a = unit(axis);
  if (!(dot(a, a) > 0)) return {};
  double c = std::cos(angle), s = std::sin(angle);
  auto turned = [&](const V3& v) { return c * v + s * cross(a, v) + ((1 - c) * dot(a, v)) * a; };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1}), {}};
}
inline Affine rotation(const Vec4& r) { return rotation(V3(r[0], r[1], r[2]), r[3]); }

}  // namespace wrlkit::drawing
