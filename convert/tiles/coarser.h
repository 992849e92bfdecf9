// The pieces of tiles at fewer and fewer triangles.
#pragma once
#include <span>
#include <utility>
#include <vector>

#include "base/task.h"
#include "convert/tiles/looks.h"
#include "convert/tiles/piece.h"

namespace wrlkit::tiles {

/// What is left of a piece.
struct Coarse {
  std::uint32_t from;  // of the pieces that came in
  Mesh mesh;
};

/// Where the pieces of a cell begin, and where they end.
using PieceRange = std::pair<std::uint32_t, std::uint32_t>;

/// What the tiles of one level may draw.
struct CoarseLevel {
  std::size_t count;              // all pieces together
  std::vector<PieceRange> cells;  // in which no more than `most` may be drawn; others are not asked for
};

/// For each level, the counts falling, the pieces of its cells that are left, in order, simplified so that they draw at
/// most as much, or as little as can be had: by the levels of a whole scene (geometry/simplify/world_levels.h), so that
/// small parts leave before large ones lose their form. Of lines and points, which cannot be simplified, the largest
/// stay, up to a tenth of the count. A cell that would draw more than `most` is taken from where all pieces draw less:
/// in steps of a twentieth, no less than the next level draws. Each level is made from the pieces that came in, whose
/// meshes are gone then. Memory as WorldLevels.
std::vector<std::vector<Coarse>> coarser(std::span<Piece> pieces, std::span<const CoarseLevel> levels, std::size_t most,
                                         const Looks& looks, const Task& ctx);

}  // namespace wrlkit::tiles
