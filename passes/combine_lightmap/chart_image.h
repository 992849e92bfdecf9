// A chart by itself, in the middle of a box of texels as unwrap::pack lays it, and what it looks like with fewer
// texels.
#pragma once
#include <span>
#include <vector>

#include "geometry/unwrap/charts.h"
#include "passes/combine_lightmap/page.h"
#include "passes/combine_lightmap/painting.h"

namespace wrlkit::combine {

/// Of pictures, in 255ths: root mean square, and what all but one in a hundred numbers keep below.
struct Difference {
  double mean = 0, most = 0;
};

/// Places are in texels from the upper left corner of the box.
class ChartImage {
 public:
  /// An empty one for a chart of that size, in texels.
  explicit ChartImage(unwrap::Point2 size);

  /// Between the middles of texels, as filters of viewers mix them.
  Texel4 at(double x, double y) const;

  int width() const { return width_; }
  int height() const { return height_; }
  /// Of the chart in the box, at the left and the right, and above and below.
  unwrap::Point2 margin() const { return margin_; }

  /// What triangles show, each as its entry of `painted` says. Texels whose middle is within one count as covered;
  /// where there are none, all that one touches.
  void paint(std::span<const PageTriangle> triangles, std::span<const Painted> painted, bool alpha);

  /// With `scale` times the texels along each side, each the mean of what it stands for. O(texels).
  ChartImage shrunk(unwrap::Point2 size, double scale) const;
  /// By how much that differs where the chart is, at up to 65,536 of its texels.
  Difference difference(const ChartImage& shrunk, double scale) const;

 private:
  std::size_t index(int x, int y) const { return std::size_t(y) * width_ + x; }
  void extend();

  int width_, height_;
  unwrap::Point2 margin_;
  std::vector<Texel4> texels_;
  std::vector<char> covered_;
};

}  // namespace wrlkit::combine
