// Lights as KHR_lights_punctual.
//
// Units. VRML (ISO/IEC 14772-1, 4.14.4) has a white face that looks at a light of intensity 1 shine with 1; glTF's
// faces return 1 / pi of the light that they get. So a DirectionalLight has pi times its intensity in lux, and a
// PointLight or SpotLight pi times what arrives. In glTF light always falls off with the square of the distance, in
// VRML it does so only if attenuation says so, and by default not at all: the two agree at one distance. That is the
// root mean square of the distances from the light to the points of the world's bounding box, or to those of the ball
// that the light reaches if that is less. `radius` becomes the range.
//
// A DirectionalLight lights its group only, in glTF all the world. Lights that are off are nodes without a light. The
// headlight (NavigationInfo, 6.29) is there when the world has lights of its own: a DirectionalLight with the first
// camera.
#pragma once
#include <map>
#include <string>

#include "base/diagnostics.h"
#include "base/text/json.h"
#include "scenegraph/looks/light_node.h"
#include "writers/gltf/box.h"
#include "writers/gltf/motion.h"
#include "writers/gltf/transform.h"

namespace wrlkit::gltf {

struct Light {
  NodeId source;     // none: the headlight
  Vec3 position{};   // world
  double scale = 1;  // world units in one of the light's
};

/// On, and of some effect, now or at times.
/// `switched`: events turn it on and off.
bool shines(const Scene&, NodeId light, const Motion&, bool switched);
/// Location and direction as those of a node.
Trs light_transform(const Scene&, NodeId light);
/// What cannot be expressed of lights: one message for each kind of loss, with the place of the first.
class LostLight {
 public:
  /// `at_top`: it is in no group.
  void add(const Scene&, NodeId light, bool at_top);
  void report(Diagnostics&) const;

 private:
  struct Lost {
    Span first;
    std::size_t n = 0;
  };
  std::map<std::string, Lost> values_;  // by type and field
  Lost scope_;
};
/// The intensity of glTF for one of 1 in VRML.
double full_intensity(const Scene&, const Light&, const Box& world);
void write_light(JsonOut&, const Scene&, const Light&, const Box& world);

}  // namespace wrlkit::gltf
