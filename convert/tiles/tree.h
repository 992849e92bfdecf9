// The tiles of a set in their tree.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "convert/tiles/kept_tiles.h"
#include "geometry/space_cells.h"
#include "writers/tiles/tileset.h"

namespace wrlkit::tiles {

/// A cell with what has been made of it.
struct Tile {
  ContentHash key;
  std::uint64_t n_full = 0;    // that is drawn when nothing is simplified
  std::uint64_t n_stored = 0;  // bytes of that in the store
  bool is_made = false;
  MadeTile made;
  Box full_box;  // of the pieces of a leaf
  Box box;       // of what it shows, and of its children
  Vec3 origin{};
  std::optional<double> error = {};  // metres, of the surface before it was rounded
  double said_error = 0;             // metres, as tileset.json has it
};

/// Near the middle, in few binary digits.
Vec3 origin_of(const Box& box);

/// Fills in boxes, origins and errors when all tiles are made. Boxes hold those of the children. A tile is not nearer
/// than its children, and rounding counts.
void finish_tree(const Cells& cells, std::vector<Tile>& tiles);

/// Writes files that tileset.json refers to into a folder. False, reported, when that fails.
bool write_descriptions(std::span<const TilesetFile> files, const std::string& folder, Diagnostics& diag);

/// The name of the file of a tile; empty: it shows nothing.
std::string file_of(const Cell& cell, const Tile& tile);

/// Of a finished tree, whose files are in a folder next to the tileset.
Tileset tileset_of(const Cells& cells, const std::vector<Tile>& tiles, const std::string& folder);

/// Gives the tiles that are kept their places in the folder of a set. False, reported, when it cannot be done.
bool link_tiles(const Cells& cells, const std::vector<Tile>& tiles, const KeptTiles& kept, const std::string& folder,
                Diagnostics& diag);

}  // namespace wrlkit::tiles
