// The sphere of colours of a Background.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/vec.h"

namespace wrlkit {

/// Colours between which a Background blends, from a pole: color[0] there, color[i + 1] at angle[i] radians from it.
struct Gradient {
  std::span<const double> color;  // flat, red, green, blue
  std::span<const double> angle;

  bool empty() const { return color.size() < 3; }
  std::size_t size() const;
  double last_angle() const;
  /// Beyond the last angle the last colour; between two angles a linear blend (ISO/IEC 14772-1, 6.5). Black without
  /// colours.
  Vec3 at(double angle) const;
};

/// Vertices with colours, and triangles that face the centre. Flat arrays.
struct Dome {
  std::vector<double> points, colors;
  std::vector<std::int32_t> corners;  // of each triangle, closed by -1
};

/// A dome of radius 1. `ground` counts from straight down, `sky` from straight up.
Dome make_dome(const Gradient& sky, const Gradient& ground);

}  // namespace wrlkit
