// Points of a surface, spread evenly over its area: what a simplification of it is measured by.
#pragma once
#include <limits>
#include <span>
#include <vector>

#include "base/math/matrix.h"
#include "geometry/closest_of_label.h"
#include "geometry/closest_point.h"

namespace wrlkit::simplify {

struct SurfaceSample {
  Vec3 point;
  double weight;  // area that it stands for
  Vec3 normal{};  // of length 1; none of a corner
  /// Squared distance of something else in the world that stays: the surface itself need not be nearer.
  double enough = std::numeric_limits<double>::infinity();
  /// The region of the surface that it is in, where that has colours, and the squared distance of the others.
  std::uint32_t region = ClosestOfLabel::no_label;
  double squared_depth = 0;
};

/// The surface that levels are made of, as they ask for what is nearest on it.
struct Original {
  const Triangles& surface;
  const ClosestPoint& nearest;
  const ClosestOfLabel* regions = nullptr;  // where faces of different colours meet; null: nowhere

  /// Of a face of a level: what is nearest of its region, if there are any.
  ClosestPoint::Nearest ask(const Vec3& p, std::uint32_t region, std::uint32_t guess) const {
    return regions ? regions->nearest(p, {}, region, guess) : nearest.nearest(p, {}, guess);
  }
};

/// Sets the regions of samples of a surface that has some, and how deep they are in them. O(n log n) for each region.
void find_regions(const Original& original, std::span<SurfaceSample> samples);

/// How far two surfaces are apart, and in which directions.
struct Distortion {
  double squares = 0;  // integral of the squared distance over both of them
  double max = 0;
  std::array<double, 6> products{};  // integrals of xx, yy, zz, xy, yz, zx of the ways from one to the other
  Vec3 farthest{};                   // the longest of them

  void add(const Vec3& way, double area);
};

/// What affine maps make of distortions: of a surface in all its places.
class Stretch {
 public:
  Stretch() = default;
  /// `area`: factor by which the area grows.
  explicit Stretch(const Matrix& m, double area = 1);

  /// The same surface in other places, too.
  void add(const Stretch& other);
  /// Of distortions that go through `m` first, by which the area grows by a factor of `area`.
  Stretch after(const Matrix& m, double area) const;

  /// In all places together. No less than if it were measured: what is nearest may be another point in the map.
  double squares(const Distortion& d) const;
  /// In the place where it is largest, or more where the places are stretched differently.
  double max(const Distortion& d) const;

 private:
  using Gram = std::array<double, 6>;  // products of the columns of a map, in the order of Distortion::products

  Gram sum_{1, 1, 1, 0, 0, 0};   // over all places, each times its area
  Gram most_{1, 1, 1, 0, 0, 0};  // of any place
};

/// The point number `k` of a sequence that fills a triangle evenly (of the plastic number), as steps along two edges.
std::array<double, 2> spread_in_triangle(double k);

/// About `n` points, the same ones at each run, whose weights add up to the area, and the corners (of many, some of
/// them) with little weight: it is they that stick out. Nothing for a surface without area.
std::vector<SurfaceSample> sample_surface(const Triangles& surface, std::size_t n);

/// The largest distance of the edges of a triangle from a surface, by points about that far apart: what spans a notch
/// has an edge across it, and hardly any area there.
void measure_edges(const std::array<Vec3, 3>& corners, std::uint32_t region, double spacing, const Original& original,
                   Distortion& out);

/// Of a surface from the samples of another one, and back, with about `n` questions on the way back: from each face to
/// the region that it is of, if there are any.
Distortion measure_distortion(const Triangles& surface, const ClosestPoint& nearest_on_surface,
                              std::span<const SurfaceSample> samples, const Original& original,
                              std::span<const std::uint32_t> regions, std::size_t n);

}  // namespace wrlkit::simplify
