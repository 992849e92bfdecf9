#include "geometry/simplify/surface_scales.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/places/places.h"

namespace wrlkit {
std::vector<std::uint32_t> surface_numbers(const Scene& scene, std::span<const ShapeSurface> surfaces) {
  std::vector<std::uint32_t> number(scene.node_count());
  for (std::uint32_t i = 0; i < surfaces.size(); ++i)
    for (NodeId shape : surfaces[i].shapes) number[shape.value] = i + 1;
  return number;
}

std::vector<double> largest_scales(const Scene& scene, std::span<const ShapeSurface> surfaces) {
  const auto number = surface_numbers(scene, surfaces);
  std::vector<double> scale(surfaces.size());
  for_each_place(scene, Shown::all, [&](NodeId shape, const Matrix& m) {
    if (const auto i = number[shape.value]) scale[i - 1] = std::max(scale[i - 1], scale_of(m));
  });
  for (double& s : scale)
    if (!(s > 0) || !std::isfinite(s)) s = 1;
  return scale;
}

}  // namespace wrlkit
