// TextureTransform as a map of the plane (ISO/IEC 14772-1, 6.49).
#pragma once
#include <optional>

#include "scenegraph/scene.h"

namespace wrlkit {

/// (s, t) -> (xx s + xy t + x, yx s + yy t + y): texture coordinates before and after.
struct TexcoordMap {
  double xx = 1, xy = 0, yx = 0, yy = 1, x = 0, y = 0;

  Vec2 operator()(double s, double t) const { return {xx * s + xy * t + x, yx * s + yy * t + y}; }
  double determinant() const { return xx * yy - xy * yx; }
  auto operator<=>(const TexcoordMap&) const = default;
};

/// `b` first, then `a`.
inline TexcoordMap operator*(const TexcoordMap& a, const TexcoordMap& b) {
  const Vec2 shift = a(b.x, b.y);
  return {a.xx * b.xx + a.xy * b.yx,
          a.xx * b.xy + a.xy * b.yy,
          a.yx * b.xx + a.yy * b.yx,
          a.yx * b.xy + a.yy * b.yy,
          shift[0],
          shift[1]};
}

struct TextureTransformNode {
  Vec2 center{0, 0}, scale{1, 1}, translation{0, 0};
  double rotation = 0;

  /// -C S R C T; what changes nothing where its numbers are not finite.
  TexcoordMap map() const;
};

/// The identity for no node and for nodes of other types.
TextureTransformNode read_texture_transform(const Scene&, NodeId texture_transform);
/// The node with its center at the origin, rounded to 1e-12. Null where VRML97 cannot express it: it turns before it
/// scales, so the rows of the map must be at right angles and longer than 0.
std::optional<TextureTransformNode> texture_transform_of(const TexcoordMap&);

}  // namespace wrlkit
