#include "convert/tiles/surface_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/stop.h"
#include "geometry/closest_point.h"
#include "geometry/simplify/samples.h"

namespace wrlkit::tiles {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The surfaces of pieces, around an origin.
struct Soup {
  std::vector<double> positions;
  std::vector<std::uint32_t> corners;

  Soup(std::span<const Piece> pieces, const Vec3& origin) {
    for (const auto& p : pieces) {
      if (!p.mesh.is_triangles()) continue;
      const auto first = static_cast<std::uint32_t>(positions.size() / 3);
      const auto from = p.mesh.positions.span();
      for (std::size_t i = 0; i < from.size(); ++i) positions.push_back(from[i] - origin[i % 3]);
      for (const auto c : p.mesh.corners) corners.push_back(first + c);
    }
  }
  Triangles triangles() const { return {positions, corners}; }

  /// Two of each triangle and all corners, in an order in which neighbours mostly follow one another.
  std::vector<Vec3> points() const {
    std::vector<Vec3> out;
    for (const auto& s : simplify::sample_surface(triangles(), 2 * triangles().size()))
      if (s.normal != Vec3{}) out.push_back(s.point);
    std::vector<char> is_taken(positions.size() / 3);
    for (const auto c : corners)
      if (!std::exchange(is_taken[c], 1)) out.push_back(triangles().position(c));
    return out;
  }
};

/// Asks for distances only where they may be larger than those that are known.
class Distances {
 public:
  explicit Distances(const Soup& soup) : triangles_(soup.triangles()), nearest_(triangles_) {}

  /// The distance of a point, or some number that is not above `known` when that is no less.
  double operator()(const Vec3& p, double known) {
    if (guess_ != ClosestPoint::no_guess && squared_distance(p, triangles_[guess_]) <= known * known) return 0;
    const auto found = nearest_.nearest(p, {}, guess_);
    if (found.triangle != ClosestPoint::no_guess) guess_ = found.triangle;
    return found.distance;
  }

 private:
  Triangles triangles_;
  ClosestPoint nearest_;
  std::uint32_t guess_ = ClosestPoint::no_guess;
};

double distance(const Box& box, const Vec3& p) {
  Vec3 way{};
  for (std::size_t k = 0; k < 3; ++k) way[k] = std::max({box.low[k] - p[k], p[k] - box.high[k], 0.0});
  return fast_length(way);
}

/// A point of the coarse surface, and how far it is from what has been read.
struct Open {
  Vec3 point;
  double distance = infinity;
};

double back(const Soup& coarse, std::span<const FullTile> full, const Vec3& origin, double known) {
  std::vector<Open> open;
  for (const auto& p : coarse.points()) open.push_back({p});
  for (const auto& tile : full) {
    check_stop();
    const auto may_be_near = [&](const Open& o) { return distance(tile.box, origin + o.point) < o.distance; };
    if (std::ranges::none_of(open, may_be_near)) continue;
    const Soup soup(tile.read(), origin);
    if (soup.corners.empty()) continue;
    Distances distances(soup);
    for (auto& o : open)
      if (may_be_near(o)) o.distance = std::min(o.distance, distances(o.point, known));
    std::erase_if(open, [&](const Open& o) { return o.distance <= known; });
  }
  for (const auto& o : open) known = std::max(known, o.distance);
  return known;
}

}  // namespace

double surface_error(std::span<const Piece> coarse, std::span<const FullTile> full) {
  Box box;
  for (const auto& p : coarse) box.unite(bounds_of(p.mesh));
  if (box.empty()) return infinity;
  const Soup soup(coarse, box.centre());
  if (soup.corners.empty()) return infinity;
  double error = 0;
  Distances distances(soup);
  for (const auto& tile : full) {
    check_stop();
    for (const auto& p : Soup(tile.read(), box.centre()).points()) error = std::max(error, distances(p, error));
  }
  return back(soup, full, box.centre(), error);
}

}  // namespace wrlkit::tiles
