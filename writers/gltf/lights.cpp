#include "writers/gltf/lights.h"

#include <numbers>

#include "scenegraph/nodes.h"
#include "writers/gltf/color.h"
#include "writers/gltf/number.h"

namespace wrlkit::gltf {
namespace {

constexpr double pi = std::numbers::pi;

/// Root mean square of the distances from a point to those of a box.
double mean_distance(const Vec3& p, const Box& box) {
  constexpr double mean_square = 1.0 / 12;  // of a coordinate in a unit interval about its middle
  return std::sqrt(std::pow(length(p - box.centre()), 2) + mean_square * std::pow(diagonal(box), 2));
}

/// Candela of a light of intensity 1 whose brightness in VRML is right at one distance.
double candela(const LightNode& c, const Light& light, const Box& world) {
  const double mean_of_ball = std::sqrt(3.0 / 5) * c.radius * light.scale;
  double d = world.empty() ? light.scale : mean_distance(light.position, world);
  d = std::min(d > 0 ? d : light.scale, mean_of_ball);
  double local = d / light.scale;
  double falloff = std::max(c.attenuation[0] + local * (c.attenuation[1] + local * c.attenuation[2]), 1.0);
  double candela = pi / falloff * d * d;
  return std::isnan(candela) ? 0 : candela;
}

void write_cone(JsonOut& json, const LightNode& c) {
  constexpr double smallest = 1e-3, sharp = 0.999;  // the inner cone must be inside of the outer one
  double outer = std::clamp(c.cut_off_angle, smallest, pi / 2);
  double inner = std::clamp(c.beam_width, 0.0, sharp * outer);
  json.member("spot", json_object("innerConeAngle", inner, "outerConeAngle", outer));
}

void write_headlight(JsonOut& json) { json.object("type", "directional", "name", "headlight", "intensity", pi); }

}  // namespace

bool shines(const Scene& scene, NodeId n, const Motion& motion, bool switched) {
  auto c = read_light(scene, n);
  auto intensity = scene.type(n).find("intensity", Dialect::x3d);
  if (motion.moves(n, *intensity)) c.intensity = 1;
  bool reaches = c.kind == LightNode::Kind::directional || (c.radius > 0 && fits_float(c.radius));
  return (c.on || switched) && reaches && c.intensity > 0 && fits_float(c.intensity);
}

Trs light_transform(const Scene& scene, NodeId n) {
  auto c = read_light(scene, n);
  return placed_at(c.location, looking_along(c.direction));
}

void LostLight::add(const Scene& scene, NodeId n, bool at_top) {
  const auto c = read_light(scene, n);
  const auto count = [&](Lost& lost) {
    if (lost.n++ == 0) lost.first = scene.where(n);
  };
  const std::string type(scene.type(n).name);
  if (c.kind != LightNode::Kind::directional && (c.attenuation[0] != 0 || c.attenuation[1] != 0))
    count(values_[type + ".attenuation"]);
  if (c.ambient_intensity != 0) count(values_[type + ".ambientIntensity"]);
  if (!at_top && !c.global) count(scope_);
}

void LostLight::report(Diagnostics& diag) const {
  for (const auto& [what, lost] : values_) diag.report(Diag::no_gltf_light_value, lost.first, what, lost.n);
  if (scope_.n > 0) diag.report(Diag::no_gltf_light_scope, scope_.first, scope_.n);
}

double full_intensity(const Scene& scene, const Light& light, const Box& world) {
  const auto c = read_light(scene, light.source);
  return c.kind == LightNode::Kind::directional ? pi : candela(c, light, world);
}

void write_light(JsonOut& json, const Scene& scene, const Light& light, const Box& world) {
  NodeId n = light.source;
  if (!n) return write_headlight(json);
  auto c = read_light(scene, n);
  bool sun = c.kind == LightNode::Kind::directional, is_spot = c.kind == LightNode::Kind::spot;
  json.object([&] {
    json.member("type", sun ? "directional" : is_spot ? "spot" : "point");
    if (!scene.name(n).empty()) json.member("name", scene.name(n));
    if (c.color != Vec3{1, 1, 1}) json.member("color", std::span<const float>(linear_color(c.color)));
    json.member("intensity", c.on ? to_float(c.intensity * full_intensity(scene, light, world)) : 0.0f);
    if (!sun) json.member("range", to_float(c.radius * light.scale));
    if (is_spot) write_cone(json, c);
  });
}

}  // namespace wrlkit::gltf
