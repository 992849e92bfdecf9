// What lies in the dark beyond a surface that crosses a chart: a wall of a single sheet on a floor, polygons that go
// through one another. The filter of who draws mixes texels on both sides, and would show a black seam along the
// crossing. What lies dimly beyond a transparent one, as the ground under water, shows through it, and on the shore it
// would be a fringe as well.
#pragma once
#include <cstdint>
#include <vector>

#include "light/world.h"
#include "passes/lightmap/page.h"

namespace wrlkit::bake {

enum class Shade : std::uint8_t { none, dim, dark };

/// Luminance compared with another: dark is as good as none, dim at most half.
Shade shade_beside(float light, float other);

/// Whether a surface crosses the way between two places of one chart, close above it: one that may be transparent where
/// it is dim beyond, and an opaque one where it is dark. What is near to parallel to the way does not count: the chart
/// itself is bent.
bool is_cut_off(const light::LightWorld& world, Shade shade, const drawing::V3& a, const drawing::V3& b,
                const drawing::V3& normal_a, const drawing::V3& normal_b);

/// Texels in the shade that are cut off from lit ones next to them take the mean of those, in all layers. One texel
/// deep: further in nothing mixes. Those with `inside[i]` neither give nor take. O(texels), and a ray for each such
/// pair.
void lighten_cut_off(const Page& page, PageLight& light, const std::vector<char>& inside,
                     const light::LightWorld& world);

}  // namespace wrlkit::bake
