#include "convert/tiles/surface_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <set>
#include <utility>

#include "base/stop.h"
#include "convert/tiles/color_regions.h"
#include "convert/tiles/farthest_point.h"
#include "convert/tiles/soup.h"
#include "convert/tiles/uncovered.h"
#include "geometry/closest_point.h"

namespace wrlkit::tiles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double share_of_extent = 1e-4;  // of the extent: distances that are not told apart
constexpr int most_rounds = 3;

/// What is read of the full tiles before anything is measured between points of the coarse one.
struct Known {
  double distance;                 // of the farthest point of all full tiles from the coarse surface
  std::set<std::uint32_t> colors;  // of their faces
};

Known read_full(const Soup& coarse, std::span<const FullTile> full, const Vec3& origin, double least) {
  FarthestPoint farthest(coarse, least);
  Known out;
  for (const auto& tile : full) {
    check_stop();
    const auto pieces = tile.read();
    farthest.add(pieces, origin);
    add_flat_colors(pieces, out.colors);
  }
  out.distance = farthest.bound();
  return out;
}

/// Triangles of a full tile that are asked for what is near to them.
struct Surface {
  Soup soup;
  Triangles triangles;
  ClosestPoint nearest;

  explicit Surface(Soup from) : soup(std::move(from)), triangles(soup.triangles()), nearest(triangles) {}
};

/// What of full tiles is asked, by region. The first tiles stay for the next turn, as far as there is room.
class FullSurfaces {
 public:
  using Surfaces = std::vector<std::unique_ptr<Surface>>;

  FullSurfaces(std::span<const FullTile> tiles, const ColorRegions& regions, const Vec3& origin)
      : tiles_(tiles), regions_(regions), origin_(origin), kept_(tiles.size()) {}

  /// Valid until another one is read.
  const Surfaces& read(std::size_t tile) {
    if (!kept_[tile].empty()) return kept_[tile];
    Surfaces surfaces;
    std::size_t n = 0;
    const auto pieces = tiles_[tile].read();
    for (std::size_t r = 0; r < regions_.size(); ++r) {
      surfaces.push_back(std::make_unique<Surface>(regions_.full(r, pieces, origin_)));
      n += surfaces.back()->triangles.size();
    }
    const bool stays = n_kept_ + n <= most_kept;
    if (stays) n_kept_ += n;
    auto& to = stays ? kept_[tile] : last_;
    to = std::move(surfaces);
    return to;
  }

 private:
  static constexpr std::size_t most_kept = 200'000;  // triangles: some 20 MB

  std::span<const FullTile> tiles_;
  const ColorRegions& regions_;
  Vec3 origin_;
  std::vector<Surfaces> kept_;
  Surfaces last_;
  std::size_t n_kept_ = 0;
};

/// Of a coarse surface.
struct Region {
  Soup soup;
  Uncovered open;
  bool is_open = true;

  Region(Soup from, const Vec3& origin, double known, double least)
      : soup(std::move(from)), open(soup, origin, known, least) {}
};

void ask(const FullTile& tile, std::size_t number, bool first, std::vector<std::unique_ptr<Region>>& regions,
         FullSurfaces& surfaces) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (!regions[r]->is_open || !regions[r]->open.concerns(tile.box, first)) continue;
    const Surface& full = *surfaces.read(number)[r];
    if (full.triangles.size() > 0) regions[r]->open.ask(tile.box, first, full.triangles, full.nearest);
  }
}

}  // namespace

double surface_error(std::span<const Piece> coarse, std::span<const FullTile> full) {
  Box box;
  for (const auto& p : coarse) box.unite(box_of_corners(p.mesh));
  if (box.empty()) return infinity;
  const Vec3 origin = box.centre();
  const Soup soup(coarse, origin);
  if (soup.corners.empty()) return infinity;
  const double least = share_of_extent * diagonal(box);
  const Known known = read_full(soup, full, origin, least);
  const ColorRegions colors(coarse, known.colors);
  std::vector<std::unique_ptr<Region>> regions;
  for (std::size_t r = 0; r < colors.size(); ++r) {
    regions.push_back(std::make_unique<Region>(colors.coarse(r, coarse, origin), origin, known.distance, least));
    regions.back()->is_open = !regions.back()->soup.corners.empty();
  }
  FullSurfaces surfaces(full, colors, origin);
  for (int round = 0; round < most_rounds; ++round) {
    for (const bool first : {true, false})
      for (std::size_t i = 0; i < full.size(); ++i) {
        check_stop();
        ask(full[i], i, first, regions, surfaces);
      }
    for (auto& r : regions) r->is_open = r->is_open && r->open.next_round();
    if (std::ranges::none_of(regions, [](const auto& r) { return r->is_open; })) break;
  }
  double out = known.distance;
  for (const auto& r : regions) out = std::max(out, r->open.farthest());
  return out;
}

}  // namespace wrlkit::tiles
