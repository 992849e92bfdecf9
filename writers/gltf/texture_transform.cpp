#include "writers/gltf/texture_transform.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::gltf {

std::optional<UvTransform> uv_transform(const TexcoordMap& a) {
  constexpr double rounding = 1e-12;
  // With F(u, v) = (u, 1 - v) the map is F a F: its linear part has the other signs off the diagonal.
  UvTransform out{{a.xy + a.x, 1 - a.yy - a.y}, {a.xx, a.yy}, 0};
  double size = std::max({std::abs(a.xx), std::abs(a.xy), std::abs(a.yx), std::abs(a.yy)}), near = rounding * size;
  if (std::abs(a.xy) <= near && std::abs(a.yx) <= near) return out;
  if (std::abs(a.xx - a.yy) > near || std::abs(a.xy + a.yx) > near) return std::nullopt;
  double scale = std::hypot(a.xx, a.yx);
  out.scale = {scale, scale};
  out.rotation = std::atan2(a.yx, a.xx);
  return out;
}

}  // namespace wrlkit::gltf
