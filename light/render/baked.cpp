#include "light/render/baked.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::drawing {
namespace {

constexpr double least = 0.1;          // of what a face gets from light that is linear over the sphere
constexpr double least_facing = 0.25;  // a lamp lower than that over a face is not made brighter for it

/// The lamp that stands for the directed part of the light.
V3 highlight(const Surface& s, const V3& light, const V3& direction, const LitPoint& at, const V3& face) {
  double directed = std::min(length(direction), 1.0);
  V3 to_light = unit(direction);
  if (!(directed > 0) || !(dot(at.normal, to_light) > 0)) return {};
  double gloss = std::max(dot(at.normal, unit(to_light + at.to_viewer)), 0.0);
  double strength =
      directed / std::max(dot(face, to_light), least_facing) * std::pow(gloss, s.material.shininess * 128);
  return strength * (light * to_linear(s.material.specular));
}

}  // namespace

LightSample sample_light(const BakedLight& baked, const std::array<double, 2>& place, double detail) {
  LightSample out{baked.at(place, detail), {}};
  if (!baked.direction[0].texture) return out;
  out.direction.emplace();
  for (std::size_t k = 0; k < 3; ++k) (*out.direction)[k] = 2 * baked.direction[k].sample(place, detail).color - V3(1);
  return out;
}

V3 baked_color(const Surface& s, const V3& base, const LightSample& sample, const LitPoint& at, const V3& face) {
  V3 light = sample.light, shine;
  if (sample.direction) {
    const auto& [x, y, z] = *sample.direction;
    V3 mean = {(x.x + x.y + x.z) / 3, (y.x + y.y + y.z) / 3, (z.x + z.y + z.z) / 3};
    shine = s.lit ? highlight(s, light, mean, at, face) : V3();
    for (double V3::*c : {&V3::x, &V3::y, &V3::z}) {
      V3 v{x.*c, y.*c, z.*c};
      light.*c *= std::max(1 + 2 * dot(v, at.normal), 0.0) / std::max(1 + 2 * dot(v, face), least);
    }
  }
  return to_srgb(to_linear(base) * light + shine + to_linear(s.emissive));
}

}  // namespace wrlkit::drawing
