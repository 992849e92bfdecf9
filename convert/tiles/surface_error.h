// How far a coarse tile is from all that it stands for, measured.
#pragma once
#include <functional>
#include <span>

#include "convert/tiles/piece.h"

namespace wrlkit::tiles {

/// Calls the function it is given with the pieces of one tile after the other, and with the box around them before; a
/// tile whose box is refused is not read.
struct FullTile {
  Box box;
  std::function<std::vector<Piece>()> read;
};

/// The largest distance between the surface of `coarse` and that of all the tiles together, both ways. Of the full
/// surface no point is farther than this, which is at most a fiftieth too much; of the coarse one the corners and two
/// points of each triangle are asked, and more where they are far (uncovered.h). Faces with a colour of their own are
/// asked for what has the same colour (color_regions.h). Infinite when one of them has no surface. Memory: `coarse`,
/// one of the tiles at a time, and the first 200,000 triangles of all. O(n log n) in the triangles.
double surface_error(std::span<const Piece> coarse, std::span<const FullTile> full);

}  // namespace wrlkit::tiles
