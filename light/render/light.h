// One light and what it adds to a surface: the lighting equation of ISO/IEC 14772-1, 4.14.4.
#pragma once
#include <optional>

#include "light/render/stage.h"
#include "scenegraph/looks/light_node.h"

namespace wrlkit::drawing {

/// Light that falls by the square of the distance, in the frame of the light.
struct SquareFall {
  double distance, strength;  // how strong it is there
};

struct Light {
  using Kind = LightNode::Kind;

  Kind kind = Kind::directional;
  V3 color{1};
  double intensity = 1, ambient_intensity = 0;
  V3 direction{0, 0, -1};  // in which the light travels; unit, world
  V3 location;             // world
  Affine to_local;         // distances are measured in the frame of the light
  V3 attenuation{1, 0, 0};
  double radius = 100, beam_width = 0, cut_off_angle = 0;
  std::optional<SquareFall> fall;  // instead of attenuation and radius
};

/// What the equation needs of the material at a point.
struct Lit {
  V3 diffuse, specular;
  double ambient = 0.2, shininess = 0.2;
};

struct LitPoint {
  V3 position, normal, to_viewer;  // world, the latter two unit
};

/// A light node in its frame; none when it is off, adds nothing or its frame has no inverse.
std::optional<Light> make_light(const Scene& scene, const Placed& placed, const Stage& stage);

/// 1 / max(1, a0 + a1 d + a2 d^2), of a distance in the frame of the light.
double attenuation(const Light& light, double distance);

/// How a light comes to a place.
struct Arrival {
  V3 to_light;          // unit; zero where the light itself stands
  double distance = 0;  // world; infinite for a DirectionalLight
  double strength = 0;  // attenuation * spot, or fall * spot; 0 beyond the radius
};
Arrival arrival(const Light& light, const V3& position);

/// The term of one light in the sum of 4.14.4: on * attenuation * spot * colour * (ambient + diffuse + specular).
V3 contribution(const Light& light, const LitPoint& at, const Lit& material);

}  // namespace wrlkit::drawing
