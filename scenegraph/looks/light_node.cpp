#include "scenegraph/looks/light_node.h"

#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

using Bool = FieldKey<FieldType::SFBool>;
using Float = FieldKey<FieldType::SFFloat>;
using Color = FieldKey<FieldType::SFColor>;
using Vector = FieldKey<FieldType::SFVec3f>;

struct Reader {
  const Scene& scene;
  NodeId n;
  LightNode to{};

  void common(LightNode::Kind kind, Bool on, Bool global, Color color, Float intensity, Float ambient_intensity) {
    to.kind = kind;
    to.on = scene.get(n, on);
    to.global = scene.get(n, global);
    to.color = scene.get(n, color);
    to.intensity = scene.get(n, intensity);
    to.ambient_intensity = scene.get(n, ambient_intensity);
  }
  void lamp(Vector location, Vector attenuation, Float radius) {
    to.location = scene.get(n, location);
    to.attenuation = scene.get(n, attenuation);
    to.radius = scene.get(n, radius);
  }
  void directional() {
    namespace f = nodes::directional_light;
    common(LightNode::Kind::directional, f::on, f::global, f::color, f::intensity, f::ambientIntensity);
    to.direction = scene.get(n, f::direction);
  }
  void point() {
    namespace f = nodes::point_light;
    common(LightNode::Kind::point, f::on, f::global, f::color, f::intensity, f::ambientIntensity);
    lamp(f::location, f::attenuation, f::radius);
  }
  void spot() {
    namespace f = nodes::spot_light;
    common(LightNode::Kind::spot, f::on, f::global, f::color, f::intensity, f::ambientIntensity);
    lamp(f::location, f::attenuation, f::radius);
    to.direction = scene.get(n, f::direction);
    to.beam_width = scene.get(n, f::beamWidth);
    to.cut_off_angle = scene.get(n, f::cutOffAngle);
  }
};

}  // namespace

bool is_light(const Scene& scene, NodeId n) { return scene.is(n, nodes::X3DLightNode); }

LightNode read_light(const Scene& scene, NodeId n) {
  Reader r{scene, n};
  if (scene.is(n, nodes::DirectionalLight)) r.directional();
  if (scene.is(n, nodes::PointLight)) r.point();
  if (scene.is(n, nodes::SpotLight)) r.spot();
  return r.to;
}

}  // namespace wrlkit
