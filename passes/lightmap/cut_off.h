// What lies in the dark beyond a surface that crosses a chart: a wall of a single sheet on a floor, polygons that go through one another. The
// filter of who draws mixes texels on both sides, and would show a black seam along the crossing.
#pragma once
#include <vector>

#include "passes/light/world.h"
#include "passes/lightmap/page.h"

namespace wrlkit::bake {

/// Whether a surface crosses the way between two places of one chart, close above it. What is near to parallel to the way does not count: the
/// chart itself is bent.
bool is_cut_off(const light::LightWorld& world, const drawing::V3& a, const drawing::V3& b, const drawing::V3& normal_a, const drawing::V3& normal_b);

/// Luminance that is as good as none beside another.
bool is_dark_beside(float light, float other);

/// Texels in the dark that are cut off from lit ones beside them take the mean of those, in all layers. One texel deep: further in nothing
/// mixes. Those with `inside[i]` neither give nor take. O(texels), and a ray for each such pair.
void lighten_cut_off(const Page& page, PageLight& light, const std::vector<char>& inside, const light::LightWorld& world);

}  // namespace wrlkit::bake
