// Scenes of any size as 3D Tiles: what `wrlkit tiles` does.
#pragma once
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "convert/document.h"
#include "convert/options.h"
#include "writers/tiles/tileset.h"

namespace wrlkit {

struct TilesOptions {
  std::size_t triangles = 50'000;   // that a tile draws, at most, and segments and points
  std::size_t draws = 32;           // calls that draw a tile, as far as its looks allow it
  std::uint64_t bytes = 4 << 20;    // of a tile, as far as can be told before it is made
  std::size_t tiles_in_file = 500;  // that tileset.json describes; more are described in files next to the tiles
  std::size_t at_once = 1'500'000;  // triangles that are simplified together; decides about bytes (triangles_within)
  SaveOptions save = {.compress = GltfCompression::Method::meshopt};  // how the content is stored
  std::string passes = {};               // that each file goes through first, as -p has them
  std::optional<EarthPlace> place = {};  // none: in coordinates of its own
  /// Which program this is: tiles are taken as they are only from runs of the same one. Empty: from none.
  std::string program = {};
  /// One of several processes that make a set together, in one folder, from the same files with the same options.
  std::uint32_t shard = 0, shards = 1;
  bool update = false;  // what has been made stays for the next run, which then makes again only what has changed
};

/// What TilesOptions::at_once may be where a run has so many bytes of memory: no more than there are by default, nor
/// less than three tiles have. It depends on nothing else, so that runs with the same memory make the same tiles.
std::size_t triangles_within(std::uint64_t memory);

/// One of the files that make the world.
struct TilesInput {
  std::string path;
  std::string name;  // what it is called in tables of names
};

/// One tile of the set.
struct TileFigures {
  std::string file;
  std::uint32_t depth = 0;
  double error = 0;  // metres that its surface is from the full one, at most
  std::size_t triangles = 0, draws = 0;
  std::size_t parts = 0;  // different names
  std::uint64_t bytes = 0;
};

struct TilesMade {
  Ending ending = Ending::failed;
  std::vector<TileFigures> tiles = {};  // the root is the first
  std::size_t depth = 0;                // levels behind the root
  std::size_t n_files = 0, n_failed = 0;
  std::vector<std::string> inlined = {};         // names of files that others of the set inline
  std::size_t triangles = 0, parts = 0;          // of all files
  std::vector<std::size_t> shown = {};           // parts, by level: of its tiles and of full tiles above it
  std::size_t n_cut = 0;                         // pieces of surfaces that are too large for a tile
  std::map<std::string, std::size_t> lost = {};  // nodes that tiles have no place for, by type, and ROUTEs
  std::uint64_t bytes = 0;
  std::size_t n_descriptions = 0;  // tileset.json, and files that it refers to
  std::size_t n_over = 0;          // tiles that have more draws or bytes than they should
  std::size_t n_kept = 0;          // tiles that were made before, from the same parts with the same options
  bool whole = false;              // the set is there; it is not when other shards have something to make
  std::size_t n_left = 0;          // tiles that were not there when this shard had made its own

  explicit operator bool() const { return ending == Ending::good || ending == Ending::partly; }
};

/// Reads the files one after the other through `reader`, whose messages are then those of all of them; one that cannot
/// be read costs itself, and one that another of them inlines is shown where that one shows it, and nowhere else.
/// Writes `folder`/tileset.json, and its tiles into a folder next to it that is called after their contents; whole or
/// not at all: tileset.json comes last, and what an earlier one referred to is removed then.
///
/// Tiles are kept in `folder`/.wrlkit until the set is whole: a run that was killed is gone on with by the next one,
/// and shards find what the others have made. The last of them to end makes the tiles above, and the set.
///
/// Memory: one file with its scene, then the triangles of TilesOptions::at_once with some 350 bytes each and 40 MB on
/// each thread, and 100 bytes for each part; the rest lies in a temporary file in `folder`, about as large as the
/// vertices of the world. A file that does not fit into what may be allocated costs itself, as one that cannot be read.
/// The same bytes for any number of threads.
TilesMade make_tiles(std::span<const TilesInput> inputs, const std::string& folder, const TilesOptions& options,
                     Document& reader);

}  // namespace wrlkit
