#include "geometry/shapes/circle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wrlkit {

int circle_segments(double radius, const Tessellation& options, int shown) {
  if (options.segments > 0) return std::clamp(options.segments, 3, 1024);
  const bool automatic = !(options.tolerance > 0);
  if (automatic && shown > 0) return std::clamp(shown, 3, 1024);
  const double sagitta = automatic ? 0.005 * std::sqrt(radius) : options.tolerance;
  const double most = automatic ? 64 : 256;
  // sagitta = r (1 - cos(pi / n)) = 2 r sin(pi / 2n)^2, which keeps its digits where the sagitta is small
  const double half_angle = std::asin(std::sqrt(std::min(sagitta / (2 * radius), 0.5)));
  const double n = half_angle > 0 ? std::numbers::pi / (2 * half_angle) : most;
  return static_cast<int>(std::ceil(std::clamp(n, 8.0, most) / 4 - 1e-9)) * 4;
}

// Angles are reduced to the first quadrant, so that the points on the axes are exact and opposite ones are symmetric.
void unit_circle(int n, std::vector<double>& x, std::vector<double>& z) {
  x.resize(static_cast<std::size_t>(n) + 1);
  z.resize(static_cast<std::size_t>(n) + 1);
  for (int k = 0; k <= n; ++k) {
    const int quadrant = 4 * k / n, rest = 4 * k % n;
    const double angle = std::numbers::pi / 2 * rest / n;
    const double c = std::cos(angle), s = std::sin(angle);
    const double cosines[] = {c, -s, -c, s}, sines[] = {s, c, -s, -c};
    x[k] = -sines[quadrant % 4];
    z[k] = -cosines[quadrant % 4];
  }
}

}  // namespace wrlkit
