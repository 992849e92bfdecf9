// Which Shapes are better left to tables of places: one geometry in one look, drawn by one call wherever it stands.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wrlkit {

struct TableItem {
  std::uint32_t kind;  // of the cell that it would be merged in
  std::uint32_t look, geometry, zone;
  std::uint32_t times;  // that the zone is drawn
  bool fits;            // a table can express where it stands
  double bytes;         // of its vertices in a merged mesh
};

struct PlaceTables {
  std::vector<char> kept;       // by item
  std::size_t saved_draws = 0;  // against a draw for each item that is kept
};

/// Those that take less space than merged vertices do, dearest first, as long as there are no more than `budget` draws
/// with all cells. What is left of a kind goes into tables, too, when its geometry has one in another look and a cell
/// would take more. n log n.
PlaceTables place_tables(std::span<const TableItem> items, std::size_t budget);

}  // namespace wrlkit
