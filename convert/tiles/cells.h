// Where a plant is cut into tiles: a tree of cells by the middles of its pieces, no piece in two of them.
#pragma once
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "convert/tiles/piece_store.h"

namespace wrlkit::tiles {

struct Cell {
  std::string name = {};                     // "r", of its second child "r1"
  std::uint32_t parent = 0, depth = 0;       // the root is its own parent
  std::uint32_t begin = 0, end = 0;          // into Cells::order
  std::vector<std::uint32_t> children = {};  // into Cells::cells; none: a leaf
};

struct Cells {
  std::vector<Cell> cells;           // parents before children; the root is the first
  std::vector<std::uint32_t> order;  // pieces; those of a cell are neighbours
  std::uint32_t depth = 0;           // of the deepest
};

/// What a full tile may have, at most.
struct TileBudget {
  std::size_t drawn = 0;  // triangles, segments, points
  std::size_t draws = std::numeric_limits<std::size_t>::max();
  std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
  double packing = 1;  // bytes of geometry in a tile for each of a stored piece
};

/// What a look adds to a tile that it is in.
struct LookCost {
  std::uint32_t family = 0;  // looks of one are drawn at once
  std::uint64_t bytes = 0;   // of its pictures
};

/// Cells that are over the budget are halved twice: across the longest side of the box around the middles, at the
/// roundest number at which each half draws 40 % of it at least, so that a piece more or less rarely moves the place.
/// For draws and bytes alone only when that helps: pieces that share a picture have it in each half. `looks`: by
/// number; where there is none, a look costs nothing. The same for the same pieces. O(n log^2 n).
Cells cut_into_cells(std::span<const PieceStore::Entry> pieces, const TileBudget& most,
                     std::span<const LookCost> looks = {});

}  // namespace wrlkit::tiles
