// The pieces of a mesh as its light lies on a page.
#pragma once
#include <optional>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/unwrap/charts.h"
#include "scenegraph/looks/texture_transform_node.h"

namespace wrlkit::combine {

struct LightCharts {
  static constexpr std::uint32_t nowhere = 0xffffffff;

  unwrap::Charts charts;                // in texels of the light
  std::vector<unwrap::Point2> origin;   // of each chart: the lower left corner of its box
  std::vector<std::uint32_t> of_place;  // by place of the light: the chart; nowhere: no triangle has it
};

/// Triangles that have places of the light in common are one chart. `to_texels` maps those to texels, y upwards.
/// Nothing when there are numbers that cannot be reckoned with. O(corners).
std::optional<LightCharts> light_charts(const Mesh& mesh, const TexcoordMap& to_texels);

/// The inverse of a map whose determinant is not 0.
TexcoordMap inverse(const TexcoordMap& m);

}  // namespace wrlkit::combine
