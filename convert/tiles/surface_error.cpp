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

/// The largest distance from the points of triangles to a surface. Two bounds keep most of a triangle from being cut:
/// the distance from one triangle of the surface is convex, so no point is farther from it than the farthest corner;
/// and no point is farther from the surface than the middle is, and the way from there. What is left is cut in four.
class FarthestPoint {
 public:
  explicit FarthestPoint(const Soup& soup, double extent)
      : triangles_(soup.triangles()), nearest_(triangles_), least_(least_share * extent) {}

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
  static constexpr double least_share = 1e-4;         // of the extent: distances that are not told apart

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

/// Asks for distances only where they may be larger than those that are known.
class Distances {
 public:
  explicit Distances(const Soup& soup) : triangles_(soup.triangles()), nearest_(triangles_) {}

  /// The distance of a point, or some number that is not above `known` when that is no less.
  double operator()(const Vec3& p, double known) {
    if (guess_ != ClosestPoint::no_guess && squared_distance(p, triangles_[guess_]) <= known * known) return 0;
    const auto found = nearest_.nearest(p, {}, guess_, known);
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
