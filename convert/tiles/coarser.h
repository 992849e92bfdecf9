// The pieces of tiles at fewer and fewer triangles.
#pragma once
#include <span>
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

/// For each count, falling, the pieces that are left, simplified so that they draw at most as much, or as little as can
/// be had: by the levels of a whole scene (geometry/simplify/world_levels.h), so that small parts leave before large
/// ones lose their form. Of lines and points, which cannot be simplified, the largest stay, up to a tenth of the count.
/// Each level is made from the pieces that came in, whose meshes are gone then. Memory as WorldLevels.
std::vector<std::vector<Coarse>> coarser(std::span<Piece> pieces, std::span<const std::size_t> counts,
                                         const Looks& looks, const Task& ctx);

}  // namespace wrlkit::tiles
