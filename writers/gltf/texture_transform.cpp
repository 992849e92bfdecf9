#include "writers/gltf/texture_transform.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"

namespace wrlkit::gltf {

UvAffine uv_affine(const Scene& scene, NodeId n) {
  namespace f = nodes::texture_transform;
  return n ? uv_affine(scene.get(n, f::center), scene.get(n, f::scale), scene.get(n, f::rotation),
                       scene.get(n, f::translation))
           : UvAffine{};
}

UvAffine uv_affine(const Vec2& center, const Vec2& scale, double rotation, const Vec2& translation) {
  const double c = std::cos(rotation), s = std::sin(rotation);
  UvAffine a{scale[0] * c, -scale[0] * s, scale[1] * s, scale[1] * c, 0, 0};
  auto [x, y] = a(translation[0] + center[0], translation[1] + center[1]);
  a.x = x - center[0];
  a.y = y - center[1];
  bool finite =
      std::ranges::all_of(std::array{a.xx, a.xy, a.yx, a.yy, a.x, a.y}, [](double v) { return std::isfinite(v); });
  return finite ? a : UvAffine{};
}

std::optional<UvTransform> uv_transform(const UvAffine& a) {
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
