// From charts to pages of texels.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/unwrap/charts.h"

namespace wrlkit::unwrap {

struct PackItem {
  const Charts* charts = nullptr;
  double density = 1;        // texels per metre
  std::uint32_t copies = 1;  // more than one: the charts keep their mutual places, and all of them are placed that many
                             // times, as one piece
};

struct PackOptions {
  int padding = 2;      // texels between charts that belong to none
  int max_side = 4096;  // of a page, texels
  int side = 0;         // not 0: there is one square page of that side, and densities say only how items compare: they
                        // are multiplied by the largest factor with which everything fits
};

/// Where a chart lies: (x, y) = turned(scale * p) + (x, y) for a point p of the chart.
struct Placement {
  std::uint32_t page = 0;
  int quarter_turns = 0;  // counter-clockwise
  double scale = 1;       // texels per metre; 1 of a copy
  double x = 0, y = 0;    // texels

  Point2 apply(Point2 p) const;
};

struct PackedItem {
  std::vector<Placement> charts;  // of each chart: in its page or, when there are copies, in the piece
  std::vector<Placement> copies;  // of each copy: where the piece lies, in texels. Empty when there is only one
  bool crowded = false;           // charts of a piece share a texel
};

struct Page {
  int width = 0, height = 0;  // texels
};

struct Atlas {
  std::vector<Page> pages;
  std::vector<PackedItem> items;
  double factor = 1;  // by which densities were multiplied
};

/// Places charts so that no two of them touch texels nearer than the padding. Charts are packed by the texels that they
/// touch, so that one may lie in a hole or bay of another; they are turned by quarters, never mirrored.
///
/// - Each chart, however small, touches at least one texel that no other touches, and the middle of its box is the
///   middle of a texel if it is less than one. (But when an item that has copies has so many charts that a page has not
///   a texel for each, those beyond share one, and the item is `crowded`.)
/// - Without `side`, pages are squares; sides are powers of two up to `max_side`. The last may be lower. What is too
/// large
///   for a page is scaled down.
/// - With `side`, more pages of that side are opened only if there is not a texel for each chart.
///
/// The same places at each run. About linear in triangles, charts and texels.
Atlas pack(std::span<const PackItem> items, const PackOptions& options = {});

}  // namespace wrlkit::unwrap
