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

/// The largest distance from the points of triangles to a surface. The distance from a triangle of the surface is
/// convex, so where the corners of something are near to one of them, all of it is. What is left is cut in four.
class FarthestPoint {
 public:
  explicit FarthestPoint(const Soup& soup, double extent)
      : triangles_(soup.triangles()), nearest_(triangles_), least_(least_share * extent) {}

  /// No point is farther, of all that was added.
  double bound() const { return farthest_ + slack_; }
  void add(std::span<const Piece> pieces, const Vec3& origin) {
    std::vector<const Piece*> open;
    for (const auto& p : pieces)
      if (p.mesh.is_triangles() && !is_within(corners_of(p, origin))) open.push_back(&p);
    // The farther the farthest point is that is known, the less there is to be cut.
    for (const Piece* p : open)
      for (std::size_t i = 0; i + 2 < p->mesh.positions.size(); i += 3)
        ask(Vec3{p->mesh.positions[i], p->mesh.positions[i + 1], p->mesh.positions[i + 2]} - origin);
    for (const Piece* p : open) {
      const auto triangles = triangles_of(p->mesh);
      for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto t = triangles[i];
        cuts_left_ = most_cuts;
        add({t[0] - origin, t[1] - origin, t[2] - origin}, deepest);
      }
    }
  }

 private:
  using Triangle = std::array<Vec3, 3>;
  static constexpr int deepest = 20, most_cuts = 20'000;  // of a triangle
  static constexpr double tolerance = 0.01;               // of the distance
  static constexpr double least_share = 1e-4;             // of the extent: distances that are not told apart

  bool is_within(std::span<const Vec3> points) const {
    if (guess_ == ClosestPoint::no_guess) return false;
    const auto to = triangles_[guess_];
    return std::ranges::all_of(points, [&](const Vec3& p) { return squared_distance(p, to) <= farthest_ * farthest_; });
  }

  static std::array<Vec3, 8> corners_of(const Piece& piece, const Vec3& origin) {
    const Box box = box_of_corners(piece.mesh);
    std::array<Vec3, 8> out;
    for (int i = 0; i < 8; ++i) out[static_cast<std::size_t>(i)] = box.corner(i) - origin;
    return out;
  }

  void ask(const Vec3& p) {
    if (is_within({&p, 1})) return;
    const auto found = nearest_.nearest(p, {}, guess_);
    if (found.triangle == ClosestPoint::no_guess) return;
    guess_ = found.triangle;
    farthest_ = std::max(farthest_, found.distance);
  }

  void add(const Triangle& t, int cuts_below) {
    if (is_within(t)) return;
    const Vec3 middle = (1. / 3) * (t[0] + t[1] + t[2]);
    for (const Vec3& p : {t[0], t[1], t[2], middle}) {
      ask(p);
      if (is_within(t)) return;
    }
    double radius = 0;
    for (const Vec3& p : t) radius = std::max(radius, fast_length(p - middle));
    if (cuts_below == 0 || --cuts_left_ < 0 || !(radius > tolerance * std::max(farthest_, least_))) {
      slack_ = std::max(slack_, radius);
      return;
    }
    const Triangle between{0.5 * (t[0] + t[1]), 0.5 * (t[1] + t[2]), 0.5 * (t[2] + t[0])};
    for (std::size_t k = 0; k < 3; ++k) add({t[k], between[k], between[(k + 2) % 3]}, cuts_below - 1);
    add(between, cuts_below - 1);
  }

  Triangles triangles_;
  ClosestPoint nearest_;
  double least_, farthest_ = 0, slack_ = 0;
  std::uint32_t guess_ = ClosestPoint::no_guess;
  int cuts_left_ = 0;
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

/// Points of the coarse surface that may be farther from the full one than is known.
class OpenPoints {
 public:
  OpenPoints(const Soup& coarse, const Vec3& origin, double known) : origin_(origin), known_(known) {
    for (const auto& p : coarse.points()) open_.push_back({p});
  }

  /// Asks a tile for those that may be near to it: within what is known, or nearer than what was found.
  void ask(const FullTile& tile, bool first) {
    const auto may_be_near = [&](const Open& o) {
      const double away = distance(tile.box, origin_ + o.point);
      return first ? away <= known_ : away < o.distance;
    };
    if (std::ranges::none_of(open_, may_be_near)) return;
    const Soup soup(tile.read(), origin_);
    if (soup.corners.empty()) return;
    Distances distances(soup);
    for (auto& o : open_)
      if (may_be_near(o)) o.distance = std::min(o.distance, distances(o.point, known_));
    std::erase_if(open_, [&](const Open& o) { return o.distance <= known_; });
  }

  double farthest() const {
    double out = known_;
    for (const auto& o : open_) out = std::max(out, o.distance);
    return out;
  }

 private:
  Vec3 origin_;
  double known_;
  std::vector<Open> open_;
};

}  // namespace

double surface_error(std::span<const Piece> coarse, std::span<const FullTile> full) {
  Box box;
  for (const auto& p : coarse) box.unite(box_of_corners(p.mesh));
  if (box.empty()) return infinity;
  const Vec3 origin = box.centre();
  const Soup soup(coarse, origin);
  if (soup.corners.empty()) return infinity;
  FarthestPoint farthest(soup, diagonal(box));
  for (const auto& tile : full) {
    check_stop();
    farthest.add(tile.read(), origin);
  }
  OpenPoints open(soup, origin, farthest.bound());
  for (const bool first : {true, false})
    for (const auto& tile : full) {
      check_stop();
      open.ask(tile, first);
    }
  return open.farthest();
}

}  // namespace wrlkit::tiles
