// Which texels need more rays, where an error is asked for.
//
// Each texel has two estimates of its light, A and B, by two halves of its rays, whose noise has nothing in common.
// What the filter makes of A differs from B by its own error and by the noise of B; and the noise of B is half of what
// A and B differ by, squared. So is the error found of the filtered half, noise that is left and detail that is
// blurred, though nobody knows the light itself. What is shown has twice the rays, and half of that error, squared.
#pragma once
#include <vector>

#include "passes/lightmap/page.h"

namespace wrlkit::bake {

/// Half of what the two estimates differ by, by texel of a page.
struct Halves {
  std::vector<Rgb> direct, gathered;
  explicit Halves(std::size_t n) : direct(n), gathered(n) {}
};

/// By texel of the page: whether it needs more rays. None does where the error of all, root mean square and relative to
/// their mean light, is below that, and surely so: one standard error of it is added. Else those do that stand among
/// texels of which more than a quarter of it comes. O(texels).
std::vector<char> unsettled(const Page& page, const PageLight& light, const Halves& halves, double error,
                            bool denoised);

}  // namespace wrlkit::bake
