// How much light can be computed in a given time: small bakes are timed, and the largest is chosen that fits.
//
// Only this choice depends on the machine. What was chosen is reported as options, and those give the same bytes
// everywhere.
#pragma once
#include <functional>

namespace wrlkit::bake {

/// How large a bake is.
struct BakeSize {
  double scale = 1;  // texels a metre, relative to the largest pages
  int rays = 2;      // a point, even
};

/// Of the largest bake that is done in `seconds`, those of `trial` included, which makes a bake of that size and says
/// how long it took. With `any_scale` false only the rays are chosen. The least there is where nothing fits.
///
/// A bake is taken to last fixed + scale^2 (texel + ray * rays). Pages get larger before rays get many: noise of few
/// rays is filtered, but what is smaller than a texel is lost. Trials take less than a tenth of the time where it is
/// not very short.
BakeSize size_for_time(double seconds, bool any_scale, const std::function<double(BakeSize)>& trial);

}  // namespace wrlkit::bake
