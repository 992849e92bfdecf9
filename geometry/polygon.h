// Cutting a polygon into triangles between its corners. No point is added, so the corners keep whatever else belongs to
// them (normals, colours); the triangles turn the way the polygon does.
//
// Strictly convex polygons become a fan, all others lose one ear after the other (polygon/ear_clipper.h), which takes
// about n log n; n * sqrt(n) for a star of needles. What polygons do in real files, and what is made of it:
// - corners on a straight edge become corners of triangles with an area; there are no triangles without;
// - repeated points and spikes (there and back again) are cut off, which leaves no gap as they have no area;
// - polygons that touch themselves (a hole joined by a bridge, a point used twice) are cut without overlaps;
// - polygons that cross themselves cannot be cut without new points: they get n - 2 triangles or fewer, whose signed
//   areas sum up to that of the polygon;
// - polygons that are not planar are cut as their projection along the Newell normal.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/polygon/ear_clipper.h"

namespace wrlkit {

class PolygonCutter {
 public:
  struct Result {
    bool concave = false;   // a corner is clearly reflex
    bool crossing = false;  // crosses itself, as far as that was noticed
    bool planar = true;     // to a thousandth of its size
  };

  /// Cuts one polygon, whose corners index positions (xyz). Nothing is left of one without area, or with a coordinate
  /// that is not finite.
  Result cut(const double* positions, std::span<const std::uint32_t> corners);

  /// Cuts a polygon with holes: the points of all its rings, and for each ring the index behind its last point; the
  /// first ring is the outer one. Rings may run either way; the triangles run anticlockwise. O(points * holes).
  Result cut(std::span<const Vec2> points, std::span<const std::uint32_t> ring_ends);

  /// Three a triangle: which of the corners, or points, of the last call. Good until the next.
  std::span<const std::uint32_t> corners() const { return corners_; }

 private:
  bool project();
  bool strictly_convex() const;
  bool has_reflex_corner() const;
  int turns() const;
  double area(std::uint32_t begin, std::uint32_t end) const;
  std::uint32_t add_ring(std::uint32_t begin, std::uint32_t end, bool reverse);
  void fan();

  Result result_;
  std::vector<std::uint32_t> corners_, holes_;
  std::vector<Vec3> polygon_;
  std::vector<Vec2> points_;  // the same in the plane, anticlockwise
  Rings rings_;
  EarClipper clipper_;
};

}  // namespace wrlkit
