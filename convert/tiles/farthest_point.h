// The point of full surfaces that is farthest from a coarse one.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "convert/tiles/soup.h"

namespace wrlkit::tiles {

/// The largest distance from the points of triangles to a surface. The distance from one triangle of the surface is
/// convex, so no point of a triangle is farther from it than the farthest corner: a triangle whose corners are all near
/// the same one is known. Any other is cut across an edge between corners that are near to different ones, where both
/// are equally far: along what lies below it, and not into ever smaller pieces.
class FarthestPoint {
 public:
  /// Of `surface`, around an origin, which must outlive this. Distances that differ by a fiftieth, of `least` metres at
  /// least, are not told apart.
  FarthestPoint(const Soup& surface, double least);

  /// Adds the triangles of pieces; `origin` is that of the surface. Expected O(n log m) for n triangles here and m of
  /// the surface, and for each that lies over several as much as for these. What is not finite is left out.
  void add(std::span<const Piece> pieces, const Vec3& origin);
  /// No point is farther, of all that was added.
  double bound() const;

 private:
  using Corners = std::array<Vec3, 3>;
  /// Of a triangle.
  struct Part {
    Corners corners;
    std::array<std::uint32_t, 3> near;  // to each corner: a triangle of the surface
  };

  double enough() const;
  std::uint32_t ask(const Vec3& p);
  bool is_near(std::span<const Vec3> points, std::uint32_t triangle);
  void add(const Part& all);
  bool is_known(const Part& part);
  void give_up(const Part& part);
  void cut(const Part& part);

  Triangles triangles_;
  ClosestPoint nearest_;
  double least_, farthest_ = 0, bound_ = 0;
  std::uint32_t guess_ = ClosestPoint::no_guess;
  std::vector<Part> open_;
};

}  // namespace wrlkit::tiles
