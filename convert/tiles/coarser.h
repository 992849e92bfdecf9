// The pieces of several tiles as one coarser tile.
#pragma once
#include <vector>

#include "base/task.h"
#include "convert/tiles/looks.h"
#include "convert/tiles/piece.h"

namespace wrlkit::tiles {

/// As many of the pieces, simplified, as draw at most `most`, or as few as can be had: by the levels of a whole world
/// (geometry/simplify/world_levels.h), so that small parts leave before large ones lose their form. Of lines and
/// points, which cannot be simplified, the largest stay, up to a tenth of `most`. Names and looks stay. Positions are
/// of the world; memory as WorldLevels.
std::vector<Piece> coarser(std::vector<Piece> pieces, std::size_t most, const Looks& looks, Task& ctx);

}  // namespace wrlkit::tiles
