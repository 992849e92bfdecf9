// Frames and phases for fits.
#pragma once
#include <cmath>
#include <numbers>
#include <span>

#include "base/math/matrix.h"
#include "base/math/vec.h"

namespace wrlkit::recognising {

/// With those columns; Y and Z are unit vectors, perpendicular.
inline Matrix frame_of(const Vec3& centre, const Vec3& y, const Vec3& z) {
  return matrix_of_columns(cross(y, z), y, z, centre);
}

inline Vec3 perpendicular(const Vec3& v, const Vec3& axis) { return v - dot(v, axis) * axis; }

inline Vec3 any_perpendicular(const Vec3& axis) {
  const Vec3 other = std::abs(axis[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return unit(perpendicular(other, axis));
}

/// Sums the directions in which the first point of a regular polygon lies, as each of its points has it.
class Phase {
 public:
  /// `turn`: 1 when the columns run anticlockwise around the axis, otherwise -1.
  Phase(const Vec3& axis, int turn) : u_(any_perpendicular(axis)), w_(cross(axis, u_)), turn_(turn) {}

  void add(std::span<const Vec3> points, const Vec3& centre) {
    for (std::size_t c = 0; c < points.size(); ++c) {
      const Vec3 p = points[c] - centre;
      const double a = -turn_ * 2 * std::numbers::pi * static_cast<double>(c) / static_cast<double>(points.size());
      const double x = dot(p, u_), y = dot(p, w_);
      x_ += x * std::cos(a) - y * std::sin(a);
      y_ += x * std::sin(a) + y * std::cos(a);
    }
  }
  /// Unit length; something when the sum is nothing.
  Vec3 first() const {
    const double l = std::hypot(x_, y_);
    return l > 0 ? (x_ / l) * u_ + (y_ / l) * w_ : u_;
  }

 private:
  Vec3 u_, w_;
  int turn_;
  double x_ = 0, y_ = 0;
};

}  // namespace wrlkit::recognising
