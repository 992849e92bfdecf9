// Viewpoints as cameras. fieldOfView is that of the shorter side of the window (ISO/IEC 14772-1, 6.53), so it becomes
// yfov, which is right wherever the window is wider than high.
//
// Clipping. VRML leaves it to the browser, glTF wants numbers: zfar is twice the distance from the eye to the farthest
// corner of the world, but no more than visibilityLimit; znear is half of the avatar's size, as browsers have it, kept
// between zfar / 1000, so that small models can be seen from near by, and zfar / 100000, so that a depth buffer can
// tell surfaces of large ones apart.
#pragma once
#include "base/text/json.h"
#include "writers/gltf/box.h"
#include "writers/gltf/transform.h"

namespace wrlkit::gltf {

struct Camera {
  NodeId source;
  Vec3 position;     // world
  double scale = 1;  // of its window, to the world: some viewers ignore that of nodes, and so its node has none there
};

/// What the NavigationInfo in force says about viewing (6.29); none: its defaults.
struct Visibility {
  double avatar_size = 0.25, limit = 0;  // no limit
  bool headlight = true;
};
Visibility visibility(const Scene&, NodeId navigation_info);

/// Position and orientation as those of a node.
Trs camera_transform(const Scene&, NodeId viewpoint);
/// DEF name, otherwise the description.
std::string_view camera_name(const Scene&, NodeId viewpoint);
/// `reach`: what is that far from the camera is seen in any case.
void write_camera(JsonOut&, const Scene&, const Camera&, const Box& world, const Visibility&, double reach = 0);

}  // namespace wrlkit::gltf
