// Where a smooth surface is cut into charts, both sides of the cut shall show the same light: bilinear filters mix other
// texels on either side, and so each cut is seen as a line unless the texels along it are led to agree.
#pragma once
#include <span>
#include <vector>

#include "passes/lightmap/rgb.h"
#include "passes/lightmap/texels.h"

namespace wrlkit::bake {

/// An edge that lies on a page twice: a[0] and b[0] are one point of the surface, a[1] and b[1] the other.
struct Seam {
  Spot2 a[2], b[2];
};

/// Changes the texels along the seams by as little as makes what a bilinear filter shows on both sides the same: least
/// squares over the texels that the filter reaches, solved by conjugate gradients. Texels elsewhere stay as they are.
/// O(texels along the seams * iterations).
void close_seams(std::vector<Rgb>& texels, int width, int height, std::span<const Seam> seams, int iterations = 30);

}  // namespace wrlkit::bake
