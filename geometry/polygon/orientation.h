// On which side of a line a point lies, with a sign that is always right. Cutting polygons relies on it: with signs
// that contradict each other an ear clipper runs into corners that no polygon has.
#pragma once
#include <cmath>
#include <limits>

#include "scenegraph/value.h"

namespace wrlkit {

/// The same as `orientation`, from exact sums of exact products. Some fifty times slower.
double exact_orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// Twice the signed area of the triangle: positive when a, b, c run anticlockwise, 0 when they are collinear, exactly.
/// The value is good to a few units in the last place of its largest term; the sign is exact for coordinates whose
/// products neither overflow nor underflow.
inline double orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
  double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]), det = left - right;
  constexpr double bound = 4 * std::numeric_limits<double>::epsilon();  // twice what rounding can do
  return std::abs(det) > bound * (std::abs(left) + std::abs(right)) ? det : exact_orientation(a, b, c);
}

}  // namespace wrlkit
