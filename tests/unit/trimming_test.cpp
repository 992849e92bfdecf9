#include "passes/lower_x3d/trimming.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

using namespace wrlkit;
using namespace wrlkit::x3d;

namespace {

using Contour = std::vector<Vec2>;

Grid even_grid(int columns, int rows) {
  Grid g;
  for (int i = 0; i <= columns; ++i) g.u.push_back(static_cast<double>(i) / columns);
  for (int i = 0; i <= rows; ++i) g.v.push_back(static_cast<double>(i) / rows);
  return g;
}

Contour square_from(double low, double high) {
  return {{low, low}, {high, low}, {high, high}, {low, high}, {low, low}};
}

Contour circle_of(double r, int n, Vec2 middle = {0.5, 0.5}) {
  Contour c;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    c.push_back({middle[0] + r * std::cos(a), middle[1] + r * std::sin(a)});
  }
  return c;
}

double area_of_circle(double r, int n) { return n * r * r / 2 * std::sin(2 * std::numbers::pi / n); }

/// The area of all triangles; none may be turned over.
double area_of(const TrimmedGrid& t) {
  double sum = 0;
  for (std::size_t i = 0; i < t.triangles.size(); i += 3) {
    const Vec2 &a = t.points[t.triangles[i]], &b = t.points[t.triangles[i + 1]], &c = t.points[t.triangles[i + 2]];
    const double twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    CHECK(twice >= -1e-15);
    sum += twice / 2;
  }
  return sum;
}

/// Length of the edges that only one triangle has: of the outline, where neighbours share all corners.
double outline_of(const TrimmedGrid& t) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t i = 0; i < t.triangles.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax(t.triangles[i + k], t.triangles[i + (k + 1) % 3])];
  double sum = 0;
  for (const auto& [edge, n] : uses) {
    CHECK(n <= 2);
    const Vec2 &a = t.points[edge.first], &b = t.points[edge.second];
    if (n == 1) sum += std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  return sum;
}

}  // namespace

TEST_CASE("Contours along the lines of a grid", "[trimming]") {
  const auto whole = trim(even_grid(4, 3), {square_from(0, 1)});
  CHECK(area_of(whole) == Approx(1));
  CHECK(outline_of(whole) == Approx(4));
  const auto part = trim(even_grid(4, 4), {square_from(0.25, 0.75)});
  CHECK(area_of(part) == Approx(0.25));
  CHECK(outline_of(part) == Approx(2));
}

TEST_CASE("A hole and what is in it, whichever way the contours run", "[trimming]") {
  const int n = 40;
  const double area = 1 - area_of_circle(0.35, n) + area_of_circle(0.1, n);
  const double outline = 4 + 2 * n * (0.35 + 0.1) * std::sin(std::numbers::pi / n);
  for (const int cells : {1, 2, 7, 30}) {
    CAPTURE(cells);
    auto hole = circle_of(0.35, n);
    for (int turn = 0; turn < 2; ++turn) {
      const auto t = trim(even_grid(cells, cells), {circle_of(0.1, n), square_from(0, 1), hole});
      CHECK(area_of(t) == Approx(area));
      CHECK(outline_of(t) == Approx(outline));
      std::reverse(hole.begin(), hole.end());
    }
  }
}

TEST_CASE("Where the outermost contours run clockwise, their outside stays", "[trimming]") {
  auto hole = circle_of(0.2, 12);
  CHECK(area_of(trim(even_grid(5, 5), {hole})) == Approx(area_of_circle(0.2, 12)));
  std::reverse(hole.begin(), hole.end());
  CHECK(area_of(trim(even_grid(5, 5), {hole})) == Approx(1 - area_of_circle(0.2, 12)));
}

TEST_CASE("Contours beyond the surface end at its edge, those without an area do not count", "[trimming]") {
  CHECK(area_of(trim(even_grid(3, 3), {square_from(-1, 0.5)})) == Approx(0.25));
  CHECK(trim(even_grid(3, 3), {{{0, 0}, {1, 1}, {0, 0}}}).triangles.empty());
  CHECK(trim(even_grid(3, 3), {}).triangles.empty());
}

TEST_CASE("Contours of chance: areas and outlines are right in any grid", "[trimming]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.4, 1);
  for (int k = 0; k < 100; ++k) {
    const int n = 3 + k % 30;
    Contour star = circle_of(1, n, {0, 0});
    double area = 0, outline = 0;
    for (Vec2& p : star) {
      const double r = 0.5 * share(random);
      p = {0.5 + r * p[0], 0.5 + r * p[1]};
    }
    for (int i = 0; i < n; ++i) {
      const Vec2 &a = star[static_cast<std::size_t>(i)], &b = star[static_cast<std::size_t>((i + 1) % n)];
      area += (a[0] * b[1] - a[1] * b[0]) / 2;
      outline += std::hypot(a[0] - b[0], a[1] - b[1]);
    }
    const auto t = trim(even_grid(1 + k % 13, 1 + k % 7), {star});
    CAPTURE(k);
    CHECK(area_of(t) == Approx(area));
    CHECK(outline_of(t) == Approx(outline));
  }
}
