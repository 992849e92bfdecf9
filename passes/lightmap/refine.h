// Which texels need more rays, where an error is asked for.
//
// Each texel has two estimates of its light, by both halves of a lattice of low discrepancy. Half of their difference is an image of the error
// of their mean; a little too large a one, as the halves make up for one another. Filtered as the light is, it is that of what is shown;
// a little too small a one, as the filter prefers texels that err alike.
#pragma once
#include <vector>

#include "passes/lightmap/page.h"

namespace wrlkit::bake {

/// By texel of the page: whether it needs more rays. None does where the error of all, root mean square, is below that, relative to their mean
/// light; else those do that stand among texels of which more than a quarter of it comes. `difference`: half of what the two estimates differ by. O(texels).
std::vector<char> unsettled(Page page, const std::vector<Rgb>& difference, double error, bool denoised);

}  // namespace wrlkit::bake
