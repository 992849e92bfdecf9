// Rational splines against circles, spheres and polynomials that are known.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <numeric>

#include "passes/lower_x3d/nurbs.h"

using namespace wrlkit;
using namespace wrlkit::x3d;

namespace {

const double h = std::sqrt(0.5);
const std::vector<double> quarters{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
const std::vector<double> circle_points{1, 0,  0,  1, 1, 0,  0, 1, 0,  -1, 1, 0, -1, 0,
                                        0, -1, -1, 0, 0, -1, 0, 1, -1, 0,  1, 0, 0};
const std::vector<double> circle_weights{1, h, 1, h, 1, h, 1, h, 1};

Basis basis(int order, const std::vector<double>& knots, std::size_t count) {
  bool replaced = false;
  auto b = make_basis(order, knots, count, replaced);
  REQUIRE(b);
  CHECK_FALSE(replaced);
  return *b;
}

Curve circle() { return {basis(3, quarters, 9), circle_points, circle_weights, 3}; }

struct Sphere {
  std::vector<double> points, weights;
  Surface surface;
  Sphere() {
    // Half a circle from pole to pole, turned about Y.
    const double r[] = {0, 1, 1, 1, 0}, y[] = {-1, -1, 0, 1, 1}, w[] = {1, h, 1, h, 1};
    for (std::size_t j = 0; j < 5; ++j)
      for (std::size_t i = 0; i < 9; ++i) {
        for (double x : {r[j] * circle_points[3 * i], y[j], -r[j] * circle_points[3 * i + 1]}) points.push_back(x);
        weights.push_back(w[j] * circle_weights[i]);
      }
    surface = {basis(3, quarters, 9), basis(3, {0, 0, 0, 1, 1, 2, 2, 2}, 5), points, weights, 3};
  }
};

}  // namespace

TEST_CASE("nurbs: the polynomials sum up to 1, their slopes to 0, and slopes are what differences say", "[nurbs]") {
  const Basis b = basis(4, {0, 0, 0, 0, 0.2, 0.5, 0.5, 1, 1, 1, 1}, 7);
  for (double t : {0.0, 0.1, 0.2, 0.35, 0.5, 0.77, 1.0}) {
    const auto v = values_at(b, t);
    CHECK(std::accumulate(v.value.begin(), v.value.end(), 0.0) == Approx(1).margin(1e-14));
    CHECK(std::accumulate(v.slope.begin(), v.slope.end(), 0.0) == Approx(0).margin(1e-12));
  }
  const auto here = values_at(b, 0.35), before = values_at(b, 0.35 - 1e-6), after = values_at(b, 0.35 + 1e-6);
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(here.slope[i] == Approx((after.value[i] - before.value[i]) / 2e-6).margin(1e-6));
}

TEST_CASE("nurbs: a cubic of four points is Bezier's", "[nurbs]") {
  const std::vector<double> p{0, 0, 0, 1, 2, 0, 3, 2, 1, 4, 0, 0};
  bool replaced = false;
  const Curve c{*make_basis(4, {}, 4, replaced), p, {}, 3};
  CHECK(replaced);
  for (double t : {0.0, 0.25, 0.6, 1.0}) {
    const double s = 1 - t, b[] = {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(c.at(t)[k] == Approx(b[0] * p[k] + b[1] * p[3 + k] + b[2] * p[6 + k] + b[3] * p[9 + k]).margin(1e-14));
  }
}

TEST_CASE("nurbs: a circle is one, and its lines keep the tolerance", "[nurbs]") {
  const Curve c = circle();
  for (int i = 0; i <= 100; ++i) CHECK(length(c.at(i * 0.04)) == Approx(1).margin(1e-14));
  for (double tolerance : {0.1, 0.01, 1e-4}) {
    const auto at = cuts(c, tolerance, 0);
    double most = 0;
    for (std::size_t i = 1; i < at.size(); ++i) {
      const Vec3 a = c.at(at[i - 1]), b = c.at(at[i]);
      most = std::max(most, 1 - length({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0}));
    }
    CHECK(most <= tolerance);
    CHECK(most > tolerance / 8);
  }
  CHECK(cuts(c, 1e-9, 12).size() == 13);
  CHECK(cuts(c, 1e-9, -2).size() == 17);
}

TEST_CASE("nurbs: a sphere is one, faces outwards, and its triangles keep the tolerance", "[nurbs]") {
  const Sphere sphere;
  const Surface& s = sphere.surface;
  for (double u : {0.0, 0.3, 1.5, 3.9})
    for (double v : {0.1, 0.9, 1.4, 1.9}) {
      const Vec3 p = s.at(u, v), n = s.across(u, v);
      CHECK(length(p) == Approx(1).margin(1e-14));
      CHECK((p[0] * n[0] + p[1] * n[1] + p[2] * n[2]) / length(n) == Approx(1).margin(1e-12));
    }
  for (double tolerance : {0.05, 0.002}) {
    const Grid g = cuts(s, tolerance, 0, 0);
    double most = 0;
    for (std::size_t j = 1; j < g.v.size(); ++j)
      for (std::size_t i = 1; i < g.u.size(); ++i) {
        const Vec3 a = s.at(g.u[i - 1], g.v[j - 1]), b = s.at(g.u[i], g.v[j - 1]), c = s.at(g.u[i], g.v[j]);
        most =
            std::max(most, 1 - length({(a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3, (a[2] + b[2] + c[2]) / 3}));
      }
    CHECK(most <= tolerance);
  }
}

TEST_CASE("nurbs: a twisted patch of straight lines is cut until its triangles fit", "[nurbs]") {
  const std::vector<double> p{0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 1, 1};
  bool replaced = false;
  const Basis b = *make_basis(2, {}, 2, replaced);
  const Surface s{b, b, p, {}, 3};
  const Grid g = cuts(s, 0.01, 0, 0);
  CHECK(g.u.size() >= 5);  // the middle of a cell of n x n is 1 / (4 n^2) away
}

TEST_CASE("nurbs: what cannot be", "[nurbs]") {
  bool replaced = false;
  CHECK_FALSE(make_basis(1, {}, 9, replaced));
  CHECK_FALSE(make_basis(4, {}, 3, replaced));
  CHECK_FALSE(make_basis(1000, {}, 2000, replaced));
  for (const std::vector<double>& knots : {std::vector<double>{0, 1}, {0, 0, 1, 0, 1, 1}, {2, 2, 2, 2, 2, 2}}) {
    replaced = false;
    CHECK(make_basis(3, knots, 3, replaced));
    CHECK(replaced);
  }
  // More is asked for than can be drawn.
  CHECK(cuts(circle(), 1e-30, 0).size() <= 4097);
  CHECK(cuts(circle(), 0, 2000000000).size() <= 4097);
  CHECK(cuts(circle(), 0, -2147483647 - 1).size() <= 4097);
  const Sphere sphere;
  const Grid g = cuts(sphere.surface, 1e-30, 0, 0);
  CHECK(g.u.size() * g.v.size() <= (1 << 20));
}
