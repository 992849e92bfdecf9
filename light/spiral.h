// Directions spread evenly, by a spiral of the golden angle.
#pragma once
#include <cmath>
#include <numbers>

#include "light/render/linear.h"

namespace wrlkit::light {

/// The k-th of n directions over the cap around y whose edge is at y = `edge`; -1: over the whole sphere.
inline drawing::V3 spiral_direction(int k, int n, double edge = -1) {
  constexpr double golden_angle = std::numbers::pi * (3 - 2.23606797749978969641);
  const double y = 1 - (1 - edge) * (k + 0.5) / n, r = std::sqrt(1 - y * y), turn = k * golden_angle;
  return {r * std::cos(turn), y, r * std::sin(turn)};
}

}  // namespace wrlkit::light
