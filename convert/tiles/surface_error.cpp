#include "convert/tiles/surface_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "base/stop.h"
#include "convert/tiles/soup.h"
#include "convert/tiles/uncovered.h"
#include "geometry/closest_point.h"

namespace wrlkit::tiles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double share_of_extent = 1e-4;  // of the extent: distances that are not told apart
constexpr int most_rounds = 3;

/// The largest distance from the points of triangles to a surface. Two bounds keep most of a triangle from being cut:
/// the distance from one triangle of the surface is convex, so no point is farther from it than the farthest corner;
/// and no point is farther from the surface than the middle is, and the way from there. What is left is cut in four.
class FarthestPoint {
 public:
  explicit FarthestPoint(const Soup& soup, double extent)
      : triangles_(soup.triangles()), nearest_(triangles_), least_(share_of_extent * extent) {}

  /// No point is farther, of all that was added.
  double bound() const { return std::max(farthest_, bound_); }
  void add(std::span<const Piece> pieces, const Vec3& origin) {
    std::vector<const Piece*> open;
    for (const auto& p : pieces)
      if (p.mesh.is_triangles() && !is_within(corners_of(p, origin))) open.push_back(&p);
    // The farther the farthest point is that is known, the less there is to be cut.
    for (const Piece* p : open)
      for (std::size_t i = 0; i + 2 < p->mesh.positions.size(); i += 3)
        distance(Vec3{p->mesh.positions[i], p->mesh.positions[i + 1], p->mesh.positions[i + 2]} - origin, farthest_);
    for (const Piece* p : open) {
      const auto triangles = triangles_of(p->mesh);
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto t = triangles[i];
        add({t[0] - origin, t[1] - origin, t[2] - origin});
      }
    }
  }

 private:
  using Triangle = std::array<Vec3, 3>;
  static constexpr std::size_t most_pieces = 80'000;  // of a triangle
  static constexpr double tolerance = 0.02;           // of the distance

  /// What need not be told from the farthest point.
  double enough() const { return farthest_ + tolerance * std::max(farthest_, least_); }

  /// Whether all that is between the points is near to the triangle that was found last.
  bool is_within(std::span<const Vec3> points) {
    if (guess_ == ClosestPoint::no_guess) return false;
    const auto to = triangles_[guess_];
    const double most = enough() * enough();
    double farthest = 0;
    for (const Vec3& p : points) {
      farthest = std::max(farthest, squared_distance(p, to));
      if (farthest > most) return false;
    }
    bound_ = std::max(bound_, std::sqrt(farthest));
    return true;
  }

  static std::array<Vec3, 8> corners_of(const Piece& piece, const Vec3& origin) {
    const Box box = box_of_corners(piece.mesh);
    std::array<Vec3, 8> out;
    for (int i = 0; i < 8; ++i) out[static_cast<std::size_t>(i)] = box.corner(i) - origin;
    return out;
  }

  /// Of a point; that of any triangle when it is below `enough`.
  double distance(const Vec3& p, double enough) {
    const auto found = nearest_.nearest(p, {}, guess_, enough);
    if (found.triangle == ClosestPoint::no_guess) return infinity;
    guess_ = found.triangle;
    if (found.distance > enough) farthest_ = std::max(farthest_, found.distance);
    return found.distance;
  }

  void add(const Triangle& all) {
    open_.assign(1, all);
    // The largest pieces first: when there are too many, those that are left are small.
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const auto t = open_[i];
      if (is_settled(t, open_.size() < most_pieces)) continue;
      const Triangle between{0.5 * (t[0] + t[1]), 0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0])};
      for (std::size_t k = 0; k < 3; ++k) open_.push_back({t[k], between[k], between[(k + 2) % 3]});
      open_.push_back(between);
    }
  }

  /// Whether no point of it can be much farther than the farthest that is known; what may be cut no more is.
  bool is_settled(const Triangle& t, bool may_be_cut) {
    if (is_within(t)) return true;
    const Vec3 middle = (1. / 3) * (t[0] + t[1] + t[2]);
    double radius = 0;
    for (const Vec3& p : t) radius = std::max(radius, fast_length(p - middle));
    const double most = distance(middle, std::max(enough() - radius, 0.)) + radius;
    if (most > enough() && may_be_cut) return is_within(t);
    bound_ = std::max(bound_, most);
    return true;
  }

  Triangles triangles_;
  ClosestPoint nearest_;
  double least_, farthest_ = 0, bound_ = 0;
  std::uint32_t guess_ = ClosestPoint::no_guess;
  std::vector<Triangle> open_;
};

/// Of the farthest point of all full tiles from the coarse surface: no point is farther.
double distance_from_full(const Soup& coarse, std::span<const FullTile> full, const Vec3& origin, double extent) {
  FarthestPoint farthest(coarse, extent);
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
