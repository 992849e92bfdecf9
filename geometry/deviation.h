// How far two surfaces are apart: in metres from points of each to the nearest point of the other, and in radians
// between their normals there. What a simplification did, what a conversion changed.
#pragma once
#include "geometry/closest_point.h"

namespace wrlkit {

/// From points of one surface to another. Distances in the unit of the positions; angles in radians, from 0 to pi: a
/// face that was turned over deviates by pi. The means are over the area of the one surface.
struct OneSidedDeviation {
  double rms = 0, max = 0;  // distance
  Vec3 where{};             // a point of the one surface that is `max` from the other
  double normal_mean = 0, normal_rms = 0, normal_max = 0;
};

/// Both ways together: means are over both ways alike, maxima the larger ones. `max` is the Hausdorff distance, or a
/// little less.
struct Deviation : OneSidedDeviation {
  OneSidedDeviation forward, backward;  // from the first surface to the second; back
};

struct DeviationOptions {
  /// On each surface, in addition to its corners. 0: four for each triangle of both, from 500 to 400,000.
  std::size_t samples = 0;
};

/// Two-sided distance (Cignoni, Rocchini, Scopigno: Metro, 1998), sampled.
///
/// - Samples are spread evenly over the area, the same ones at each run; the corners are asked, too, for the maximum,
///   which is followed uphill from the worst samples. A peak may be missed that is smaller than the samples are apart.
/// - A triangle that both surfaces have deviates by exactly nothing. Samples are spent on the others only, so that one
///   changed part is measured as well in a plant as alone.
/// - Triangles without area count for `max` and as something to be near to; when a surface has no others, `rms` is that
///   of its corners. Triangles that are not finite, or beyond 1e18, are left out.
/// - Where thousands of large triangles pass through one another, fewer points are asked.
/// - When one surface is empty and the other is not, both distances are infinite, and `where` is a corner.
///
/// O(n log n) in the triangles, some 100 bytes for each of them; runs on all threads, with the same result on any
/// number.
Deviation measure_deviation(const Triangles& a, const Triangles& b, const DeviationOptions& options = {});

/// A surface whose triangles have labels, such as colours.
struct LabeledTriangles {
  Triangles surface;
  std::span<const std::uint32_t> labels;
};

/// How far the regions of a surface reach beyond those of another one: from each point to the nearest one with the same
/// label, sampled as above. Triangles whose label is not below `n_labels` are left out. Infinite where the other
/// surface has nothing with a label.
OneSidedDeviation measure_labeled(const LabeledTriangles& from, const LabeledTriangles& to, std::uint32_t n_labels);

}  // namespace wrlkit
