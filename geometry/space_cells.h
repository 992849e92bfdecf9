// Where a plant is cut in space: a tree of cells by the middles of its pieces, no piece in two of them.
#pragma once
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "base/math/box.h"

namespace wrlkit {

/// What is not cut.
struct SpaceItem {
  std::uint32_t bytes = 0;    // as it is stored
  std::uint32_t n_drawn = 0;  // triangles, segments, points
  Box box = {};
  std::uint32_t look = 0;
};

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

/// What a cell without children may have, at most.
struct CellBudget {
  std::size_t drawn = 0;  // triangles, segments, points
  std::size_t draws = std::numeric_limits<std::size_t>::max();
  std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
  double packing = 1;  // bytes of geometry for each of a stored piece
};

/// What a look adds to a cell that it is in.
struct LookCost {
  std::uint32_t family = 0;  // looks of one are drawn at once
  std::uint64_t bytes = 0;   // of its pictures
};

/// Cells that are over the budget are halved twice: across the longest side of the box around the middles, at the
/// roundest number at which each half draws 40 % of it at least, so that a piece more or less rarely moves the place.
/// For draws and bytes alone only when that helps: pieces that share a picture have it in each half. `looks`: by
/// number; where there is none, a look costs nothing. The same for the same pieces. O(n log^2 n).
Cells cut_into_cells(std::size_t n, const std::function<const SpaceItem&(std::uint32_t)>& piece, const CellBudget& most,
                     std::span<const LookCost> looks = {});

template <class Pieces>
Cells cut_into_cells(const Pieces& pieces, const CellBudget& most, std::span<const LookCost> looks = {}) {
  const auto piece = [&](std::uint32_t i) -> const SpaceItem& { return pieces[i]; };
  return cut_into_cells(pieces.size(), piece, most, looks);
}

}  // namespace wrlkit
