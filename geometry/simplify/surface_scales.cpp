#include "geometry/simplify/surface_scales.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"
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

std::vector<double> largest_scales(const Scene& scene, const Scene& expanded, std::span<const ShapeSurface> surfaces) {
  std::vector<double> by_geometry(expanded.node_count());
  for_each_place(expanded, Shown::all, [&](NodeId shape, const Matrix& m) {
    const NodeId geometry = expanded.get(shape, nodes::shape::geometry);
    const double s = scale_of(m);
    if (geometry && s > 0 && std::isfinite(s)) by_geometry[geometry.value] = std::max(by_geometry[geometry.value], s);
  });
  auto scale = largest_scales(scene, surfaces);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (const double s = by_geometry[surfaces[i].geometry.value]; s > 0) scale[i] = s;
  return scale;
}

}  // namespace wrlkit
