#include "light/lamp_reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "light/spiral.h"
#include "light/world.h"

namespace wrlkit::light {
namespace {

/// Along a ray to the first opaque surface; none when there is none.
std::optional<double> opaque_distance(const LightWorld& world, const Ray& ray) {
  constexpr int most_layers = 32;
  double after = 0;
  Hit hit;
  for (int layer = 0; layer < most_layers && world.nearest(ray, after, hit); ++layer, after = hit.distance)
    if (!world.is_clear(hit.use) && !world.is_bulb(hit.use)) return hit.distance;
  return {};
}

}  // namespace

std::optional<double> lamp_reach(const drawing::Light& lamp, const LightWorld& world) {
  constexpr int n = 256;
  const bool spot = lamp.kind == drawing::Light::Kind::spot;
  const double edge = spot ? std::cos(std::clamp(lamp.cut_off_angle, 0.0, std::numbers::pi)) : -1;
  const V3 axis = lamp.direction, aside = unit(cross(axis, std::fabs(axis.x) < 0.5 ? V3(1, 0, 0) : V3(0, 1, 0))),
           across = cross(axis, aside);
  double squares = 0;
  int n_met = 0;
  for (int k = 0; k < n; ++k) {
    const V3 turned = spiral_direction(k, n, edge), direction = turned.y * axis + turned.x * aside + turned.z * across;
    const auto distance = opaque_distance(world, {lamp.location, direction});
    if (!distance) continue;
    const double local = std::min(length(lamp.to_local.vector(*distance * direction)), lamp.radius);
    squares += local * local;
    ++n_met;
  }
  if (!(squares > 0)) return {};
  return std::sqrt(squares / n_met);
}

}  // namespace wrlkit::light
