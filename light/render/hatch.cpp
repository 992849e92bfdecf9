#include "light/render/hatch.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"

namespace wrlkit::drawing {

bool Hatch::covers(double x, double y) const {
  constexpr double width = 0.15;
  const auto is_line = [](double v) { return v - std::floor(v) < width; };
  const bool falling = is_line((x - y) / std::sqrt(2)), rising = is_line((x + y) / std::sqrt(2));
  switch (style) {
    case 0:
      return false;
    case 1:
      return is_line(y);
    case 2:
      return is_line(x);
    case 4:
      return falling;
    case 5:
      return is_line(x) || is_line(y);
    case 6:
      return rising || falling;
    default:
      return rising;
  }
}

std::optional<Hatch> read_hatch(const Scene& scene, NodeId n) {
  namespace f = nodes::fill_properties;
  if (!scene.is(n, nodes::FillProperties)) return std::nullopt;
  const auto color = scene.get(n, f::hatchColor);
  Hatch hatch{scene.get(n, f::filled), {color[0], color[1], color[2]}, 0};
  if (scene.get(n, f::hatched)) hatch.style = std::max(0, scene.get(n, f::hatchStyle));
  return hatch.is_filled && hatch.style == 0 ? std::nullopt : std::optional(hatch);
}

}  // namespace wrlkit::drawing
