// The points of a coarse surface that may be farther from the full one than is known.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "convert/tiles/soup.h"

namespace wrlkit::tiles {

/// The largest distance from the points of a coarse surface to a full one that is read tile after tile, in rounds. The
/// first one asks the corners and two points of each triangle. The others look between the points of triangles that are
/// not much nearer than the farthest one: pieces of those are near enough by two bounds (the distance from one
/// full triangle is convex, so no point is farther from it than the farthest corner; and no point is farther than the
/// middle is, and the way from there) or are cut in two, across the edge along which the distance from the nearest full
/// triangle grows most.
class Uncovered {
 public:
  /// `coarse`, around `origin`, must outlive this. `known`: metres that the two are apart in any case: nearer points do
  /// not matter. Distances that differ by a twentieth, of `least` metres at least, are not told apart.
  Uncovered(const Soup& coarse, const Vec3& origin, double known, double least);

  /// Whether a tile in that box has to be asked: in the first turn if it is near, in the second if it may be nearer
  /// than what was found.
  bool concerns(const Box& box, bool first) const;
  /// Asks it. Expected O(n log m) for n triangles of the coarse surface in the box and m of the tile.
  void ask(const Box& box, bool first, const Triangles& full, const ClosestPoint& nearest);
  /// Ends a round of two turns over all tiles. False when nothing is left to ask.
  bool next_round();

  /// Metres; what has been found, of all points.
  double farthest() const { return known_; }

 private:
  using Corners = std::array<Vec3, 3>;
  static constexpr std::uint32_t no_triangle = 0xffffffff;
  struct Open {
    Corners corners;
    double reach;     // metres from its middle
    double distance;  // of the middle from what has been read
  };
  struct Point {
    Vec3 at;
    double distance;         // from what has been read
    std::uint32_t triangle;  // of the coarse surface that it is on; none of a corner
  };

  double enough() const;
  bool may_concern(const Open& open, const Box& box, bool first) const;
  bool may_concern(const Point& point, const Box& box, bool first) const;
  double ask(const Vec3& p, const Triangles& full, const ClosestPoint& nearest);
  void settle(const Open& all, const Triangles& full, const ClosestPoint& nearest, bool may_cut);
  bool is_within(const Corners& corners, const Triangles& full, double distance) const;
  void look_between_points();
  void cut(const Open& open, const Corners& full);

  const Soup& coarse_;
  Vec3 origin_;
  double known_, least_;
  std::vector<Point> points_;  // of the first round
  std::vector<Open> open_, left_, pieces_;
  std::uint32_t guess_ = ClosestPoint::no_guess;
  bool is_between_points_ = false;
};

}  // namespace wrlkit::tiles
