// TextureTransform (ISO/IEC 14772-1, 6.49) for glTF, whose texture coordinates count from the top of the picture and
// not from the bottom.
#pragma once
#include <optional>

#include "scenegraph/looks/texture_transform_node.h"

namespace wrlkit::gltf {

/// The values of KHR_texture_transform.
struct UvTransform {
  Vec2 offset{0, 0}, scale{1, 1};
  double rotation = 0;
};

/// The same map for coordinates that count from the top. Null when the extension has none: VRML scales after it
/// turns, the extension before; and viewers are known to disagree about the order. Such transforms are applied to the
/// coordinates.
std::optional<UvTransform> uv_transform(const TexcoordMap&);

}  // namespace wrlkit::gltf
