// Where a smooth surface is cut into charts, both sides of the cut shall show the same light: bilinear filters mix
// other texels on either side, and so each cut is seen as a line unless the texels along it are led to agree.
#pragma once
#include <span>
#include <vector>

#include "passes/lightmap/rgb.h"
#include "passes/lightmap/texels.h"

namespace wrlkit::bake {

/// One side of a cut: a line on a page.
struct SeamSide {
  std::uint32_t page;
  Spot2 end[2];
};

/// An edge of the surface that lies in two places: a.end[0] and b.end[0] are one point, a.end[1] and b.end[1] the
/// other.
struct Seam {
  SeamSide a, b;
};

/// The texels of a page, row 0 the lowest.
struct Canvas {
  int width = 0, height = 0;
  std::vector<Rgb> texels;
  /// By texel: it lies within something, and its light is made up. Empty: none does.
  std::vector<char> inside{};
};

/// How well both sides of the seams agree.
struct SeamReport {
  std::uint64_t places = 0;  // along the seams, two a texel
  std::uint64_t jumps = 0;   // where the sides differ by more than a tenth, and by what is seen
};

/// Changes the texels along the seams by as little as makes what a bilinear filter shows on both sides the same: least
/// squares over the texels that the filter reaches, solved by conjugate gradients. Texels elsewhere stay as they are.
/// Places that lie within something on either side do not count: nobody sees that side, and the light of the other one
/// may end there. O(texels along the seams * iterations).
SeamReport close_seams(std::span<Canvas> pages, std::span<const Seam> seams, int iterations = 60);

}  // namespace wrlkit::bake
