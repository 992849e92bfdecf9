// What stands between the charts of a page: the light of the nearest charts goes on there, so that filters and smaller
// versions of the picture never mix in black.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "passes/lightmap/rgb.h"

namespace wrlkit::bake {

/// Charts go on where something covers them: every texel of a chart with `known[i] == 0` becomes known, in each layer
/// the mean of its known neighbours in that chart, those next to them first. `chart` is by texel. Charts without a
/// known texel stay unknown. O(texels).
void fill_charts(std::span<std::vector<Rgb>> layers, std::vector<char>& known, std::span<const std::uint32_t> chart,
                 std::uint32_t no_chart, int width, int height);

/// Gives every texel with `known[i] == 0` a colour: the mean of the known ones around it, at the finest scale that has
/// any (pull and push over halved pictures; Gortler et al. 1996). Known texels stay. Without any known one all is
/// black. O(texels).
void fill(std::vector<Rgb>& texels, const std::vector<char>& known, int width, int height);

}  // namespace wrlkit::bake
