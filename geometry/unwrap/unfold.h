// From a surface to charts: pieces of it, laid flat.
#pragma once
#include <cstdint>
#include <span>

#include "geometry/unwrap/charts.h"

namespace wrlkit::unwrap {

struct UnfoldInput {
  std::span<const double> positions;       // xyz, metres
  std::span<const std::uint32_t> corners;  // the position of each, three a triangle, counter-clockwise from the front
  std::span<const std::uint32_t> groups;   // of each triangle, which no chart crosses; empty: all are one
};

struct UnfoldOptions {
  double crease_angle = 1.05;  // radians: where faces meet at more, charts are cut
  double max_stretch = 1.02;   // root mean square over a chart (Sander et al. 2001, L2)
};

/// Unfolds a surface. Neighbours are those that share positions, so equal points must have been joined.
///
/// - What is developable (planes, cylinders, cones, chains of such) is unrolled without any distortion, and coplanar
///   neighbours come into one chart. The rest is cut into charts whose stretch is bounded. (A plane of more than 2,000
///   triangles around one point may come in several charts.)
/// - Triangles of a chart never overlap, and none is mirrored.
/// - Charts are cut at borders, creases, groups, edges of more than two triangles and where the winding turns over.
/// - Each triangle has a chart. One without area, or not finite, covers nothing: it lies on a neighbour's edge or, when
///   it has none, in a last chart of no size.
///
/// The same charts at each run. O(n log n) in the triangles, some 200 bytes for each.
Charts unfold(const UnfoldInput& in, const UnfoldOptions& options = {});

}  // namespace wrlkit::unwrap
