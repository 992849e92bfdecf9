// Rational B-splines (Piegl and Tiller, The NURBS Book, chapters 2 to 4): points, derivatives, and how finely they are
// cut.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scenegraph/value.h"

namespace wrlkit::x3d {

/// One parameter: as many polynomials as control points.
struct Basis {
  int order = 0;  // degree plus one
  std::size_t count = 0;
  std::vector<double> knots;  // count + order, not decreasing

  double first() const { return knots[static_cast<std::size_t>(order) - 1]; }
  double last() const { return knots[count]; }
};

constexpr int highest_order = 32;

/// None where there are less control points than `order`, which is from 2 to `highest_order`. Knots that are not as
/// many as they have to be, decrease, or leave no interval, are those of a curve from the first point to the last, in
/// equal steps: `replaced`.
std::optional<Basis> make_basis(int order, std::span<const double> knots, std::size_t count, bool& replaced);

/// The `order` polynomials that are not 0 at a parameter, and their slopes.
struct BasisValues {
  std::size_t first = 0;  // control point of the first of them
  std::vector<double> value, slope;
};
/// O(order^2).
BasisValues values_at(const Basis&, double t);

/// A curve, of control points with 2 or 3 coordinates.
struct Curve {
  Basis basis;
  std::span<const double> points;  // of `arity` coordinates
  std::vector<double> weights;     // one for each; none: 1
  std::size_t arity = 3;

  Vec3 at(double t) const;
};

/// A surface of count x count control points, those of u next to one another. The same for texture coordinates.
struct Surface {
  Basis u, v;
  std::span<const double> points;
  std::vector<double> weights;
  std::size_t arity = 3;

  Vec3 at(const BasisValues& u, const BasisValues& v) const;
  Vec3 at(double s, double t) const { return at(values_at(u, s), values_at(v, t)); }
  /// Square to the surface, u x v, of any length; 0 where the surface has a point.
  Vec3 across(double s, double t) const;
};

/// Parameters from end to end at which a curve is cut into straight lines that stay within `tolerance` of it.
/// `tessellation` as in NurbsCurve, and as the author has it, where it is not 0. At most 4096 lines. O(lines).
std::vector<double> cuts(const Curve&, double tolerance, int tessellation);

struct Grid {
  std::vector<double> u, v;
};
/// Parameters of both directions so that triangles between neighbours stay within `tolerance` of the surface; at most a
/// million points.
Grid cuts(const Surface&, double tolerance, int u_tessellation, int v_tessellation);

}  // namespace wrlkit::x3d
