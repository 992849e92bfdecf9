// Sums of light: what arrives at a place, and from where.
#pragma once
#include <algorithm>
#include <numbers>

#include "light/color.h"

namespace wrlkit::light {

using std::numbers::pi;

/// A place that light falls on.
struct Receiver {
  V3 start;                 // where its rays start: off the surface
  V3 face, normal;          // of the triangle and for shading; unit
  std::uint32_t scope = 0;  // the DirectionalLights that light it: Use::lights
};

/// A sum of samples with what their scatter and direction say.
struct Flux {
  V3 sum, squares;
  V3 along[3];  // of sum: times x, y and z of the direction to where it comes from

  void add(const V3& e, const V3& from) {
    sum += e;
    squares += e * e;
    along[0] += from.x * e;
    along[1] += from.y * e;
    along[2] += from.z * e;
  }
  /// Of the mean of n samples, by their scatter. For samples of low discrepancy that is an upper bound.
  V3 variance(double n) const {
    if (n < 2) return {};
    V3 mean = (1 / n) * sum;
    return max(V3(), (1 / (n * (n - 1))) * (squares - n * (mean * mean)));
  }
};

/// The direction about a normal for a place in the unit square: dense by the cosine.
inline V3 cosine_direction(const V3& normal, double u, double v) {
  double sign = std::copysign(1.0, normal.z), a = -1 / (sign + normal.z), b = normal.x * normal.y * a;
  V3 s{1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x}, t{b, sign + normal.y * normal.y * a, -normal.y};
  double r = std::sqrt(u), angle = 2 * pi * v;
  return r * std::cos(angle) * s + r * std::sin(angle) * t + std::sqrt(std::max(0.0, 1 - u)) * normal;
}

}  // namespace wrlkit::light
