// Spreads the distortion of a chart: each triangle pulls its corners to where its true shape would have them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/unwrap/links.h"

namespace wrlkit::unwrap {

/// For a triangle laid at `t` that has that shape: the largest and the smallest factor of its lengths. The smallest is
/// negative when it is mirrored.
struct Stretch {
  double most = 1, least = 1;
};
Stretch stretch_of(const Triangle2& shape, const Triangle2& t);

/// A chart as it grows: points, and for each triangle its three.
struct Flattened {
  std::vector<Point2> points;
  std::vector<std::uint32_t> triangles;     // numbers of the surface
  std::vector<std::uint32_t> corner_point;  // three a triangle

  Triangle2 at(std::size_t i) const {
    return {points[corner_point[3 * i]], points[corner_point[3 * i + 1]], points[corner_point[3 * i + 2]]};
  }
  void clear() {
    points.clear();
    triangles.clear();
    corner_point.clear();
  }
};

class Relaxer {
 public:
  /// As-rigid-as-possible steps (Sorkine and Alexa 2007, in the form of Bouaziz et al. 2012): each triangle is moved
  /// rigidly to where it fits best, then each point goes to the mean of its triangles, by their areas. The energy falls
  /// with each step. O(triangles) a step.
  void run(const Links& links, Flattened& chart, int steps);

 private:
  std::vector<Point2> sums_, before_;
  std::vector<double> weights_;
};

}  // namespace wrlkit::unwrap
