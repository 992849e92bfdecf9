// From a function of the place to a picture: few samples where it is smooth, many where it changes.
#pragma once
#include <functional>

#include "light/render/linear.h"
#include "scenegraph/resources.h"

namespace wrlkit::drawing {

struct Raster {
  int width = 1280, height = 960;
  int samples = 4;  // along each side of a pixel with detail; 1: the middle of each pixel, and nothing else

  /// Pixels between neighbouring samples.
  double span() const { return samples < 2 ? 1 : 0.5; }
};

/// The RGB picture of `color(x, y)`, each component in [0, 1], x and y in pixels from the upper left corner. Four
/// samples a pixel first; pixels that differ from one of their neighbours, or in themselves, then get samples *
/// samples. Rows are done in parallel; the picture does not depend on how.
Image sample_picture(const Raster& raster, const std::function<V3(double x, double y)>& color);

}  // namespace wrlkit::drawing
