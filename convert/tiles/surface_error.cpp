#include "convert/tiles/surface_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/stop.h"
#include "convert/tiles/farthest_point.h"
#include "convert/tiles/soup.h"
#include "convert/tiles/uncovered.h"
#include "geometry/closest_point.h"

namespace wrlkit::tiles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double share_of_extent = 1e-4;  // of the extent: distances that are not told apart
constexpr int most_rounds = 3;

/// Of the farthest point of all full tiles from the coarse surface: no point is farther.
double distance_from_full(const Soup& coarse, std::span<const FullTile> full, const Vec3& origin, double extent) {
  FarthestPoint farthest(coarse, share_of_extent * extent);
  for (const auto& tile : full) {
    check_stop();
    farthest.add(tile.read(), origin);
  }
  return farthest.bound();
}

/// The surfaces of full tiles, ready to be asked. The first ones stay for the next turn, as far as there is room.
class FullSurfaces {
 public:
  FullSurfaces(std::span<const FullTile> tiles, const Vec3& origin)
      : tiles_(tiles), origin_(origin), kept_(tiles.size()) {}

  struct Surface {
    Soup soup;
    Triangles triangles;
    ClosestPoint nearest;

    Surface(std::span<const Piece> pieces, const Vec3& origin)
        : soup(pieces, origin), triangles(soup.triangles()), nearest(triangles) {}
  };

  /// Valid until another one is read.
  const Surface& read(std::size_t tile) {
    if (kept_[tile]) return *kept_[tile];
    auto surface = std::make_unique<Surface>(tiles_[tile].read(), origin_);
    const auto n = surface->triangles.size();
    const bool stays = n_kept_ + n <= most_kept;
    if (stays) n_kept_ += n;
    auto& to = stays ? kept_[tile] : last_;
    to = std::move(surface);
    return *to;
  }

 private:
  static constexpr std::size_t most_kept = 200'000;  // triangles: some 20 MB

  std::span<const FullTile> tiles_;
  Vec3 origin_;
  std::vector<std::unique_ptr<Surface>> kept_;
  std::unique_ptr<Surface> last_;
  std::size_t n_kept_ = 0;
};

}  // namespace

double surface_error(std::span<const Piece> coarse, std::span<const FullTile> full) {
  Box box;
  for (const auto& p : coarse) box.unite(box_of_corners(p.mesh));
  if (box.empty()) return infinity;
  const Vec3 origin = box.centre();
  const Soup soup(coarse, origin);
  if (soup.corners.empty()) return infinity;
  const double extent = diagonal(box);
  Uncovered open(soup, origin, distance_from_full(soup, full, origin, extent), share_of_extent * extent);
  FullSurfaces surfaces(full, origin);
  for (int round = 0; round < most_rounds; ++round) {
    for (const bool first : {true, false})
      for (std::size_t i = 0; i < full.size(); ++i) {
        check_stop();
        if (!open.concerns(full[i].box, first)) continue;
        const auto& tile = surfaces.read(i);
        if (tile.triangles.size() > 0) open.ask(full[i].box, first, tile.triangles, tile.nearest);
      }
    if (!open.next_round()) break;
  }
  return open.farthest();
}

}  // namespace wrlkit::tiles
