// A set of tiles as tileset.json: 3D Tiles 1.1 (OGC 22-025r4).
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/math/box.h"
#include "base/math/matrix.h"

namespace wrlkit {

/// Where the origin of a scene is on the Earth (WGS 84): degrees, metres above the ellipsoid, and where -z of the world
/// points to, in degrees from north towards east.
struct EarthPlace {
  double latitude = 0, longitude = 0, height = 0, heading = 0;
};

struct TilesetTile {
  std::string name;                        // its file has that name, and the one that describes it, if there is one
  bool has_content = false;                // NAME.glb
  Vec3 origin{};                           // of the content
  Box box;                                 // of it and of all children, both in the coordinates of the world, y up
  double error = 0;                        // metres
  std::vector<std::size_t> children = {};  // in the list
};

struct Tileset {
  std::vector<TilesetTile> tiles;  // the root is the first
  double error = 0;                // when nothing is shown
  std::optional<EarthPlace> place;
  std::string folder;                     // in which the tiles are, next to tileset.json
  std::size_t tiles_in_file = unlimited;  // tiles that one file describes, at most
  static constexpr auto unlimited = std::numeric_limits<std::size_t>::max();
};

/// A description of tiles: tileset.json, or NAME.json in the folder of the tiles.
struct TilesetFile {
  std::string path, text;
};

/// From the world to the coordinates of the Earth, earth-centred and earth-fixed.
Matrix earth_matrix(const EarthPlace& place);

/// All tiles are refined by REPLACE. Coordinates of the set are z up: x, -z, y of the world, or those of the Earth; the
/// transform of each tile puts its origin there, in double precision. The first file is tileset.json, which refers to
/// the others where there are more tiles than a file may describe: each describes a tile with what is below it, and the
/// largest that fit are files, so viewers load few of them. O(tiles).
std::vector<TilesetFile> tileset_files(const Tileset& set);

}  // namespace wrlkit
