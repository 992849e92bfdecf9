#include "scenegraph/looks/light_node.h"

#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

void read_directional(const Scene& scene, NodeId n, LightNode& to) {
  namespace f = nodes::directional_light;
  to.kind = LightNode::Kind::directional;
  to.on = scene.get(n, f::on);
  to.global = scene.get(n, f::global);
  to.color = scene.get(n, f::color);
  to.intensity = scene.get(n, f::intensity);
  to.ambient_intensity = scene.get(n, f::ambientIntensity);
  to.direction = scene.get(n, f::direction);
}

void read_point(const Scene& scene, NodeId n, LightNode& to) {
  namespace f = nodes::point_light;
  to.kind = LightNode::Kind::point;
  to.on = scene.get(n, f::on);
  to.global = scene.get(n, f::global);
  to.color = scene.get(n, f::color);
  to.intensity = scene.get(n, f::intensity);
  to.ambient_intensity = scene.get(n, f::ambientIntensity);
  to.location = scene.get(n, f::location);
  to.attenuation = scene.get(n, f::attenuation);
  to.radius = scene.get(n, f::radius);
}

void read_spot(const Scene& scene, NodeId n, LightNode& to) {
  namespace f = nodes::spot_light;
  to.kind = LightNode::Kind::spot;
  to.on = scene.get(n, f::on);
  to.global = scene.get(n, f::global);
  to.color = scene.get(n, f::color);
  to.intensity = scene.get(n, f::intensity);
  to.ambient_intensity = scene.get(n, f::ambientIntensity);
  to.location = scene.get(n, f::location);
  to.attenuation = scene.get(n, f::attenuation);
  to.radius = scene.get(n, f::radius);
  to.direction = scene.get(n, f::direction);
  to.beam_width = scene.get(n, f::beamWidth);
  to.cut_off_angle = scene.get(n, f::cutOffAngle);
}

}  // namespace

bool is_light(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::DirectionalLight) || scene.is(n, nodes::PointLight) || scene.is(n, nodes::SpotLight);
}

LightNode read_light(const Scene& scene, NodeId n) {
  LightNode out;
  if (scene.is(n, nodes::DirectionalLight)) read_directional(scene, n, out);
  if (scene.is(n, nodes::PointLight)) read_point(scene, n, out);
  if (scene.is(n, nodes::SpotLight)) read_spot(scene, n, out);
  return out;
}

}  // namespace wrlkit
