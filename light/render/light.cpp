#include "light/render/light.h"

#include <algorithm>

namespace wrlkit::drawing {
namespace {

/// Lamps have a size: nearer than a tenth of the distance it is as strong as there.
double strength(const SquareFall& fall, double distance) {
  const double times = fall.distance / std::max(distance, fall.distance / 10);
  return fall.strength * times * times;
}

/// spot_i of 4.14.4. A beamWidth beyond cutOffAngle means cutOffAngle (6.45).
double spot(const Light& l, const V3& to_light) {
  double angle = std::acos(std::clamp(-dot(l.direction, to_light), -1.0, 1.0));
  if (angle >= l.cut_off_angle) return 0;
  if (angle <= l.beam_width) return 1;
  return (l.cut_off_angle - angle) / (l.cut_off_angle - l.beam_width);
}

}  // namespace

double attenuation(const Light& l, double distance) {
  double fall = l.attenuation.x + distance * (l.attenuation.y + distance * l.attenuation.z);
  return 1 / std::max(fall, 1.0);
}

std::optional<Light> make_light(const Scene& scene, const Placed& placed, const Stage& stage) {
  const LightNode n = read_light(scene, placed.node);
  if (!n.on) return {};
  Light l{.kind = n.kind,
          .color = n.color,
          .intensity = n.intensity,
          .ambient_intensity = n.ambient_intensity,
          .direction = n.direction,
          .location = n.location,
          .attenuation = n.attenuation,
          .radius = n.radius,
          .beam_width = n.beam_width,
          .cut_off_angle = n.cut_off_angle};
  const Affine& frame = stage.frames[placed.frame];
  l.location = frame.point(l.location);
  l.direction = unit(frame.vector(l.direction));
  l.to_local = frame.inverse();
  bool placeable = l.kind == Light::Kind::directional || finite(l.to_local);
  if (!placeable || !finite(l.location) || !finite(l.direction) || !(l.intensity > 0 || l.ambient_intensity > 0))
    return {};
  return l;
}

Arrival arrival(const Light& light, const V3& position) {
  if (light.kind == Light::Kind::directional) return {-light.direction, std::numeric_limits<double>::infinity(), 1};
  V3 way = light.location - position;
  double local = length(light.to_local.vector(way));
  if (!light.fall && local > light.radius) return {};
  Arrival a{unit(way), length(way), light.fall ? strength(*light.fall, local) : attenuation(light, local)};
  if (light.kind == Light::Kind::spot) a.strength *= spot(light, a.to_light);
  return a;
}

V3 contribution(const Light& light, const LitPoint& at, const Lit& material) {
  auto [to_light, distance, strength] = arrival(light, at.position);
  if (!(strength > 0)) return {};
  V3 sum = (light.ambient_intensity * material.ambient) * material.diffuse;
  double facing = dot(at.normal, to_light);
  if (facing > 0) {
    // The standard has no such condition on the highlight, but graphics cards had it: none on the side in the dark.
    double gloss = std::max(dot(at.normal, unit(to_light + at.to_viewer)), 0.0);
    sum += (light.intensity * facing) * material.diffuse;
    sum += (light.intensity * std::pow(gloss, material.shininess * 128)) * material.specular;
  }
  return strength * (light.color * sum);
}

}  // namespace wrlkit::drawing
