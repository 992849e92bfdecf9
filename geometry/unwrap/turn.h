// Turns a flat piece so that the rectangle around it is as small as can be, and lies along the axes.
#pragma once
#include <vector>

#include "geometry/unwrap/charts.h"

namespace wrlkit::unwrap {

/// The rectangle begins at (0, 0) and is at least as wide as high; gives its size. Rotated, never mirrored. The
/// smallest rectangle has a side along one of the convex hull (Freeman and Shapira 1975). O(n log n).
class Turner {
 public:
  Point2 turn(std::vector<Point2>& points);

 private:
  void make_hull(const std::vector<Point2>& points);
  std::vector<Point2> sorted_, hull_;
};

}  // namespace wrlkit::unwrap
