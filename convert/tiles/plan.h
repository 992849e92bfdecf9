// Which tiles there will be, and how much each of them may draw.
#pragma once
#include <span>
#include <vector>

#include "convert/tiles.h"
#include "convert/tiles/looks.h"
#include "convert/tiles/piece_store.h"
#include "convert/tiles/tree.h"
#include "geometry/space_cells.h"

namespace wrlkit::tiles {

/// Cells within the budgets of the options. As cut_into_cells.
Cells planned_cells(std::span<const PieceStore::Entry> pieces, const Looks& looks, const TilesOptions& options);

/// Questions about cells whose tiles are known by what they show in full (Tile::n_full, Tile::n_stored). Views.
class Plan {
 public:
  Plan(const Cells& cells, const std::vector<Tile>& tiles, const TilesOptions& options)
      : cells_(cells.cells), tiles_(tiles), options_(options) {}

  bool is_leaf(std::uint32_t cell) const { return cells_[cell].children.empty(); }
  /// Whether all that is in a cell can be simplified at once.
  bool fits(std::uint32_t cell) const { return tiles_[cell].n_full <= options_.at_once; }
  /// The largest cell that is made at once with this one.
  std::uint32_t top_of(std::uint32_t cell) const;
  /// What a coarse tile draws, at most.
  std::size_t target(std::uint32_t cell) const;
  /// Triangles of a whole group at which the tiles of a level have as many as they may have.
  std::size_t count_of(std::span<const std::uint32_t> level, std::size_t n_drawn) const;
  /// The cells in one, itself included, in the order in which a tree is walked.
  std::vector<std::uint32_t> cells_below(std::uint32_t top) const;

 private:
  const std::vector<Cell>& cells_;
  const std::vector<Tile>& tiles_;
  const TilesOptions& options_;
};

}  // namespace wrlkit::tiles
