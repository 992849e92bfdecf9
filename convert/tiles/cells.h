// Where a plant is cut into tiles: a tree of cells by the middles of its pieces, no piece in two of them.
#pragma once
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

/// Cells that draw more than `most` are halved twice: across the longest side of the box around the middles, at the
/// roundest number at which each half draws 40 % of it at least, so that a piece more or less rarely moves the place.
/// The same for the same pieces. O(n log^2 n).
Cells cut_into_cells(std::span<const PieceStore::Entry> pieces, std::size_t most);

}  // namespace wrlkit::tiles
