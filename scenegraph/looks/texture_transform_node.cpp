#include "scenegraph/looks/texture_transform_node.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenegraph/nodes.h"

namespace wrlkit {

TexcoordMap TextureTransformNode::map() const {
  const double c = std::cos(rotation), s = std::sin(rotation);
  TexcoordMap m{scale[0] * c, -scale[0] * s, scale[1] * s, scale[1] * c, 0, 0};
  const auto [x, y] = m(translation[0] + center[0], translation[1] + center[1]);
  m.x = x - center[0];
  m.y = y - center[1];
  const bool finite =
      std::ranges::all_of(std::array{m.xx, m.xy, m.yx, m.yy, m.x, m.y}, [](double v) { return std::isfinite(v); });
  return finite ? m : TexcoordMap{};
}

TextureTransformNode read_texture_transform(const Scene& scene, NodeId n) {
  namespace f = nodes::texture_transform;
  if (!scene.is(n, nodes::TextureTransform)) return {};
  return {scene.get(n, f::center), scene.get(n, f::scale), scene.get(n, f::translation), scene.get(n, f::rotation)};
}

std::optional<TextureTransformNode> texture_transform_of(const TexcoordMap& m) {
  const double sx = std::hypot(m.xx, m.xy), sy = std::hypot(m.yx, m.yy);
  if (!(sx > 0 && sy > 0) || std::abs(m.xx * m.yx + m.xy * m.yy) > 1e-9 * sx * sy ||
      !std::isfinite(sx + sy + m.x + m.y))
    return {};
  const double angle = std::atan2(-m.xy, m.xx), c = std::cos(angle), s = std::sin(angle);
  const double signed_sy = m.yx * s + m.yy * c, x = m.x / sx, y = m.y / signed_sy;
  auto rounded = [](double v) { return std::round(v * 1e12) / 1e12 + 0.0; };
  TextureTransformNode out;
  out.scale = {rounded(sx), rounded(signed_sy)};
  out.rotation = rounded(angle);
  out.translation = {rounded(c * x + s * y), rounded(c * y - s * x)};
  return out;
}

}  // namespace wrlkit
