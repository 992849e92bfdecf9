// The values of a light node, whichever of the three it is (ISO/IEC 14772-1, 6.16, 6.35 and 6.45).
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// In the frame of the node. What its type does not have keeps its value here.
struct LightNode {
  enum class Kind : std::uint8_t { directional, point, spot };

  Kind kind = Kind::directional;
  bool on = true, global = true;
  Vec3 color{1, 1, 1};
  double intensity = 1, ambient_intensity = 0;
  Vec3 location{0, 0, 0};
  Vec3 direction{0, 0, -1};  // in which the light travels; of any length
  Vec3 attenuation{1, 0, 0};
  double radius = 100, beam_width = 0, cut_off_angle = 0;
};

bool is_light(const Scene&, NodeId);
LightNode read_light(const Scene&, NodeId light);

}  // namespace wrlkit
