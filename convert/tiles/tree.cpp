#include "convert/tiles/tree.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/io/output.h"

namespace wrlkit::tiles {
namespace {

namespace fs = std::filesystem;

constexpr double single_precision = 1.0 / (1 << 22);

}  // namespace

Vec3 origin_of(const Box& box) {
  const double step = std::exp2(std::floor(std::log2(std::max(diagonal(box), 1e-9))) - 6);
  Vec3 out = box.centre();
  for (double& x : out) x = std::round(x / step) * step;
  return out;
}

void finish_tree(const Cells& cells, std::vector<Tile>& tiles) {
  for (std::size_t i = tiles.size(); i-- > 0;) {
    Tile& tile = tiles[i];
    const auto& children = cells.cells[i].children;
    tile.box = tile.made.box;
    if (!children.empty()) tile.said_error = tile.error.value_or(0) + tile.made.rounding;
    for (const auto child : children) {
      tile.box.unite(tiles[child].box);
      tile.said_error = std::max(tile.said_error, tiles[child].said_error);
    }
    tile.origin = origin_of(tile.made.box.empty() ? tile.box : tile.made.box);
  }
}

std::string file_of(const Cell& cell, const Tile& tile) {
  return tile.made.bytes > 0 ? cell.name + ".glb" : std::string();
}

Tileset tileset_of(const Cells& cells, const std::vector<Tile>& tiles, const std::string& folder) {
  const double extent = diagonal(tiles[0].box);
  Tileset set{.tiles = {}, .error = std::max(extent, tiles[0].said_error), .place = {}, .folder = folder};
  double grown = single_precision * extent;
  for (const auto& tile : tiles) grown = std::max(grown, 2 * tile.made.rounding);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const Cell& cell = cells.cells[i];
    Box box = tiles[i].box;
    box.low = box.low - Vec3{grown, grown, grown};
    box.high = box.high + Vec3{grown, grown, grown};
    set.tiles.push_back({cell.name,
                         tiles[i].made.bytes > 0,
                         tiles[i].origin,
                         box,
                         tiles[i].said_error,
                         {cell.children.begin(), cell.children.end()}});
  }
  return set;
}

bool write_descriptions(std::span<const TilesetFile> files, const std::string& folder, Diagnostics& diag) {
  for (const auto& described : files) {
    auto file = OutputFile::open((fs::path(folder) / fs::path(described.path).filename()).string(), {}, diag);
    if (!file) return false;
    file->write(described.text);
    if (!file->commit(diag)) return false;
  }
  return true;
}

bool link_tiles(const Cells& cells, const std::vector<Tile>& tiles, const KeptTiles& kept, const std::string& folder,
                Diagnostics& diag) {
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const auto file = file_of(cells.cells[i], tiles[i]);
    if (file.empty()) continue;
    const auto from = kept.tile_path(tiles[i].key), to = folder + '/' + file;
    std::error_code fault;
    fs::create_hard_link(from, to, fault);
    if (fault) fs::copy_file(from, to, fault);  // not every file system has links
    if (!fault) continue;
    diag.report(Diag::cannot_write, {}, to, fault.message());
    return false;
  }
  return true;
}

}  // namespace wrlkit::tiles
