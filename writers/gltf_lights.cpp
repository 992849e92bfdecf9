#include "writers/gltf_lights.h"

#include <numbers>

#include "scenegraph/nodes.h"
#include "writers/gltf_color.h"
#include "writers/gltf_number.h"

namespace wrlkit::gltf {
namespace {

constexpr double pi = std::numbers::pi;

/// The fields that the three kinds have in common.
struct Common {
  Vec3 color, location{0, 0, 0}, direction{0, 0, -1}, attenuation{0, 0, 1};
  double intensity, ambient, radius = 0;
  bool on;
};

Common directional(const Scene& scene, NodeId n) {
  namespace f = nodes::directional_light;
  return {.color = scene.get(n, f::color),
          .direction = scene.get(n, f::direction),
          .intensity = scene.get(n, f::intensity),
          .ambient = scene.get(n, f::ambientIntensity),
          .on = scene.get(n, f::on)};
}

Common point(const Scene& scene, NodeId n) {
  namespace f = nodes::point_light;
  return {.color = scene.get(n, f::color),
          .location = scene.get(n, f::location),
          .attenuation = scene.get(n, f::attenuation),
          .intensity = scene.get(n, f::intensity),
          .ambient = scene.get(n, f::ambientIntensity),
          .radius = scene.get(n, f::radius),
          .on = scene.get(n, f::on)};
}

Common spot(const Scene& scene, NodeId n) {
  namespace f = nodes::spot_light;
  return {.color = scene.get(n, f::color),
          .location = scene.get(n, f::location),
          .direction = scene.get(n, f::direction),
          .attenuation = scene.get(n, f::attenuation),
          .intensity = scene.get(n, f::intensity),
          .ambient = scene.get(n, f::ambientIntensity),
          .radius = scene.get(n, f::radius),
          .on = scene.get(n, f::on)};
}

Common common(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::DirectionalLight)) return directional(scene, n);
  return scene.is(n, nodes::PointLight) ? point(scene, n) : spot(scene, n);
}

/// Root mean square of the distances from a point to those of a box.
double mean_distance(const Vec3& p, const Box& box) {
  constexpr double mean_square = 1.0 / 12;  // of a coordinate in a unit interval about its middle
  return std::sqrt(std::pow(distance(p, box.centre()), 2) + mean_square * std::pow(box.extent(), 2));
}

/// Candela of a light of intensity 1 whose brightness in VRML is right at one distance.
double candela(const Common& c, const Light& light, const Box& world) {
  const double mean_of_ball = std::sqrt(3.0 / 5) * c.radius * light.scale;
  double d = world.empty() ? light.scale : mean_distance(light.position, world);
  d = std::min(d > 0 ? d : light.scale, mean_of_ball);
  double local = d / light.scale;
  double falloff = std::max(c.attenuation[0] + local * (c.attenuation[1] + local * c.attenuation[2]), 1.0);
  double candela = pi / falloff * d * d;
  return std::isnan(candela) ? 0 : candela;
}

void write_cone(JsonOut& json, const Scene& scene, NodeId n) {
  namespace f = nodes::spot_light;
  constexpr double smallest = 1e-3, sharp = 0.999;  // the inner cone must be inside of the outer one
  double outer = std::clamp(scene.get(n, f::cutOffAngle), smallest, pi / 2);
  double inner = std::clamp(scene.get(n, f::beamWidth), 0.0, sharp * outer);
  json.key("spot");
  json.begin_object();
  json.member("innerConeAngle", inner);
  json.member("outerConeAngle", outer);
  json.end_object();
}

void write_headlight(JsonOut& json) {
  json.begin_object();
  json.member("type", "directional");
  json.member("name", "headlight");
  json.member("intensity", pi);
  json.end_object();
}

}  // namespace

bool is_light(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::DirectionalLight) || scene.is(n, nodes::PointLight) || scene.is(n, nodes::SpotLight);
}

bool is_global(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::DirectionalLight)) return scene.get(n, nodes::directional_light::global);
  return scene.is(n, nodes::PointLight) ? scene.get(n, nodes::point_light::global) : scene.get(n, nodes::spot_light::global);
}

bool shines(const Scene& scene, NodeId n, const Motion& motion) {
  auto c = common(scene, n);
  auto intensity = scene.type(n).find("intensity", Dialect::x3d);
  if (motion.moves(n, *intensity)) c.intensity = 1;
  bool reaches = scene.is(n, nodes::DirectionalLight) || (c.radius > 0 && fits_float(c.radius));
  return c.on && reaches && c.intensity > 0 && fits_float(c.intensity);
}

Trs light_transform(const Scene& scene, NodeId n) {
  auto c = common(scene, n);
  return placed_at(c.location, looking_along(c.direction));
}

void report_lost_light(const Scene& scene, NodeId n, bool at_top, Diagnostics& diag) {
  auto c = common(scene, n);
  auto type = scene.type(n).name;
  if (c.attenuation[0] != 0 || c.attenuation[1] != 0)
    diag.report(Diag::no_gltf_value, scene.where(n), type, "attenuation");
  if (c.ambient != 0) diag.report(Diag::no_gltf_value, scene.where(n), type, "ambientIntensity");
  if (!at_top && !is_global(scene, n)) diag.report(Diag::no_gltf_light_scope, scene.where(n), type);
}

double full_intensity(const Scene& scene, const Light& light, const Box& world) {
  return scene.is(light.source, nodes::DirectionalLight) ? pi : candela(common(scene, light.source), light, world);
}

void write_light(JsonOut& json, const Scene& scene, const Light& light, const Box& world) {
  NodeId n = light.source;
  if (!n) return write_headlight(json);
  auto c = common(scene, n);
  bool sun = scene.is(n, nodes::DirectionalLight), is_spot = scene.is(n, nodes::SpotLight);
  json.begin_object();
  json.member("type", sun ? "directional" : is_spot ? "spot" : "point");
  if (!scene.name(n).empty()) json.member("name", scene.name(n));
  if (c.color != Vec3{1, 1, 1}) json.member("color", std::span<const float>(linear_color(c.color)));
  json.member("intensity", to_float(c.intensity * full_intensity(scene, light, world)));
  if (!sun) json.member("range", to_float(c.radius * light.scale));
  if (is_spot) write_cone(json, scene, n);
  json.end_object();
}

}  // namespace wrlkit::gltf
