// TextureTransform (ISO/IEC 14772-1, 6.49) for glTF, whose texture coordinates count from the top of the picture and
// not from the bottom.
#pragma once
#include <optional>

#include "scenegraph/scene.h"

namespace wrlkit::gltf {

/// (s, t) -> (xx s + xy t + x, yx s + yy t + y), coordinates of VRML before and after.
struct UvAffine {
  double xx = 1, xy = 0, yx = 0, yy = 1, x = 0, y = 0;
  Vec2 operator()(double s, double t) const { return {xx * s + xy * t + x, yx * s + yy * t + y}; }
  bool operator==(const UvAffine&) const = default;
};

/// What KHR_texture_transform says.
struct UvTransform {
  Vec2 offset{0, 0}, scale{1, 1};
  double rotation = 0;
};

/// -C S R C T of a TextureTransform; identity for none, and where its numbers are not finite.
UvAffine uv_affine(const Scene&, NodeId texture_transform);
UvAffine uv_affine(const Vec2& center, const Vec2& scale, double rotation, const Vec2& translation);

/// The same for coordinates that count from the top. Null when the extension cannot say it: VRML scales after it turns,
/// the extension before; and viewers are known to disagree about the order. Such transforms are applied to the
/// coordinates.
std::optional<UvTransform> uv_transform(const UvAffine&);

}  // namespace wrlkit::gltf
