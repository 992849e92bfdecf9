// What lies around the charts of a page, so that smaller versions of the picture (mip levels) do not mix them: filters
// of level l look one and a half of its texels beyond a border, 2^l texels of the page each.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wrlkit::bake {

/// The chart of each texel of a picture, by any number but 0, which is none.
struct ChartMap {
  std::span<const std::uint16_t> chart;
  int width = 0, height = 0;
};

/// The most levels for which the gaps of a page are seen to.
inline constexpr int most_mips = 6;

/// Of a chart in a ChartMap. Very many share numbers, neighbours hardly ever.
inline std::uint16_t chart_number(std::uint32_t chart) { return static_cast<std::uint16_t>(1 + chart % 65521); }

/// The last level whose texels are of one chart each, and have another one between those of two charts: what padding of
/// twice its texels gives. One texel in fifty may differ. O(texels).
int last_separate_level(const ChartMap& map);

/// Texels of a level that no chart has a part of, but one next to them does: they are as the border of the nearest
/// chart. Returns for each texel of the picture in these where its colour comes from, which is in a texel of the level
/// that the chart has a part of; for others their own number. O(texels).
std::vector<std::uint32_t> sources_beyond_borders(const ChartMap& map, int level);

/// Colours that `fill` has given to all texels, seen to at the borders.
template <class T>
void extend_borders(std::vector<T>& texels, std::span<const std::uint32_t> sources) {
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (sources[i] != i) texels[i] = texels[sources[i]];
}

}  // namespace wrlkit::bake
