// Packing for lightmaps: the charts of an item lie on one page, as a Shape has one lightmap, and far enough apart for
// smaller versions of the pages (mip levels).
#pragma once
#include <span>
#include <vector>

#include "geometry/unwrap/pack.h"

namespace wrlkit::bake {

/// Texels between charts that keep that many versions of a page apart: two of those of the last one. The first texel
/// next to a chart is its own, as filters at its border mix it in.
constexpr int padding_of(int mips) { return mips < 2 ? 2 : (1 << mips) + 2; }

/// The padding of the most versions, up to four, that cost no more than a tenth of the texels a metre; at least
/// `least`. `area(padding)` is that of all charts with what lies between them.
template <class F>
int affordable_padding(int least, F&& area) {
  constexpr double most = 1 / (0.9 * 0.9);  // times the area
  constexpr int most_mips = 4;
  int padding = least;
  for (int mips = 2; mips <= most_mips && area(padding_of(mips)) <= most * area(least); ++mips)
    padding = std::max(least, padding_of(mips));
  return padding;
}

/// As unwrap::pack. Where the charts of an item are not all on one page, fewer items are tried together; an item that
/// does not fit alone gets fewer texels, or a larger page where a page has not a texel for each of its charts. The
/// factor is that of the last items. Throws std::length_error where no page has.
unwrap::Atlas pack_whole(std::span<const unwrap::PackItem> items, const unwrap::PackOptions& options);

}  // namespace wrlkit::bake
