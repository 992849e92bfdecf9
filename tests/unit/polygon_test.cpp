// Cutting polygons: every simple polygon must come out as n - 2 triangles that fit together, turn the right way and
// have exactly its area. With each directed edge used once, and the polygon as their boundary, triangles that all turn
// the same way and whose areas sum up to that of the polygon can neither overlap nor stick out.
#include "geometry/polygon.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "scenegraph/nodes.h"

using namespace wrlkit;

namespace {

using Polygon = std::vector<Vec2>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

double cross(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double area2(const Polygon& p) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < p.size(); ++i) sum += cross(p[0], p[i], p[i + 1]);
  return sum;
}

struct Cut {
  PolygonCutter::Result result;
  std::vector<std::uint32_t> corners;
  std::size_t size() const { return corners.size() / 3; }
};

Cut cut(const std::vector<Vec3>& polygon) {
  static PolygonCutter cutter;
  std::vector<std::uint32_t> all;
  while (all.size() < polygon.size()) all.push_back(static_cast<std::uint32_t>(all.size()));
  auto result = cutter.cut(polygon.empty() ? nullptr : polygon[0].data(), all);
  return {result, {cutter.corners().begin(), cutter.corners().end()}};
}

std::vector<Vec3> in_plane(const Polygon& polygon, const Vec3& u = {1, 0, 0}, const Vec3& v = {0, 1, 0}) {
  std::vector<Vec3> out;
  for (auto [x, y] : polygon) out.push_back({x * u[0] + y * v[0], x * u[1] + y * v[1], x * u[2] + y * v[2]});
  return out;
}

Cut cut(const Polygon& polygon) { return cut(in_plane(polygon)); }

/// How well triangles fit together.
struct Fit {
  double area2 = 0, least = std::numeric_limits<double>::infinity();
  std::size_t n_edges_twice = 0, n_boundary = 0;
};

Fit fit(const Polygon& p, const std::vector<std::uint32_t>& corners) {
  Fit out;
  std::set<Edge> edges;
  for (std::size_t t = 0; t < corners.size(); t += 3) {
    double a = cross(p[corners[t]], p[corners[t + 1]], p[corners[t + 2]]);
    out.area2 += a;
    out.least = std::min(out.least, a);
    for (int k = 0; k < 3; ++k) out.n_edges_twice += !edges.insert({corners[t + k], corners[t + (k + 1) % 3]}).second;
  }
  for (auto [a, b] : edges) out.n_boundary += !edges.contains({b, a});
  return out;
}

/// For polygons that run anticlockwise.
void check_simple(const Polygon& p) {
  CAPTURE(p.size());
  auto c = cut(p);
  auto f = fit(p, c.corners);
  CHECK(c.size() == p.size() - 2);
  CHECK(f.area2 == Approx(area2(p)).epsilon(1e-9));
  CHECK(f.least > 0);
  CHECK(f.n_edges_twice == 0);
  CHECK(f.n_boundary == p.size());
  CHECK(!c.result.crossing);
  CHECK(c.result.planar);
}

/// For polygons that touch themselves: triangles cover them, but how many there are is up to the shape.
void check_touching(const Polygon& p, std::size_t triangles) {
  auto c = cut(p);
  auto f = fit(p, c.corners);
  CHECK(c.size() == triangles);
  CHECK(f.area2 == Approx(area2(p)).epsilon(1e-9));
  CHECK(f.least > 0);
  CHECK(!c.result.crossing);
}

Polygon regular(std::size_t n) {
  Polygon p;
  for (std::size_t i = 0; i < n; ++i) {
    double a = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    p.push_back({std::cos(a), std::sin(a)});
  }
  return p;
}

/// Around the origin at random distances: reflex corners and long thin ears.
Polygon random_star(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.05, 1);
  Polygon p = regular(n);
  for (auto& v : p) {
    double r = radius(random);
    v = {v[0] * r, v[1] * r};
  }
  return p;
}

Polygon comb(std::size_t teeth, double slant) {
  Polygon p{{0, -1}, {1, -1}};
  double width = 1.0 / static_cast<double>(teeth);
  for (std::size_t i = teeth; i-- > 0;) {
    double x = static_cast<double>(i) * width;
    p.push_back({x + 0.9 * width, 0});
    p.push_back({x + 0.5 * width + slant, 1});
  }
  p.push_back({0, 0});
  return p;
}

/// A strip wound around the origin.
Polygon spiral(std::size_t n) {
  Polygon out, in;
  for (std::size_t i = 0; i < n / 2; ++i) {
    double t = 3 + 20.0 * static_cast<double>(i) / static_cast<double>(n / 2) * 2 * std::numbers::pi;
    out.push_back({t * std::cos(t), t * std::sin(t)});
    in.push_back({(t - 2) * std::cos(t), (t - 2) * std::sin(t)});
  }
  out.insert(out.end(), in.rbegin(), in.rend());
  return out;
}

/// The outline of a set of unit squares that hang together without holes, with a corner at every unit.
Polygon outline(const std::set<std::pair<int, int>>& squares) {
  std::map<std::pair<int, int>, std::pair<int, int>> next;
  for (auto [x, y] : squares) {
    if (!squares.contains({x, y - 1})) next[{x, y}] = {x + 1, y};
    if (!squares.contains({x + 1, y})) next[{x + 1, y}] = {x + 1, y + 1};
    if (!squares.contains({x, y + 1})) next[{x + 1, y + 1}] = {x, y + 1};
    if (!squares.contains({x - 1, y})) next[{x, y + 1}] = {x, y};
  }
  Polygon p;
  auto at = next.begin()->first;
  do {
    p.push_back({double(at.first), double(at.second)});
    at = next[at];
  } while (at != next.begin()->first);
  return p;
}

/// A random maze of w * w cells without islands: right angles and straight runs of corners, all coordinates exact.
Polygon maze(int w, unsigned seed) {
  std::mt19937 random(seed);
  std::set<std::pair<int, int>> open{{0, 0}};
  std::vector<std::pair<int, int>> path{{0, 0}};
  while (!path.empty()) {
    auto [x, y] = path.back();
    std::vector<std::pair<int, int>> steps;
    for (auto [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}})
      if (int u = x + 2 * dx, v = y + 2 * dy; u >= 0 && v >= 0 && u < 2 * w && v < 2 * w && !open.contains({u, v}))
        steps.push_back({dx, dy});
    if (steps.empty()) {
      path.pop_back();
      continue;
    }
    auto [dx, dy] = steps[random() % steps.size()];
    open.insert({x + dx, y + dy});
    open.insert({x + 2 * dx, y + 2 * dy});
    path.push_back({x + 2 * dx, y + 2 * dy});
  }
  return outline(open);
}

/// Four sides of n edges each, in one plane except for rounding.
Polygon divided_square(int n, double angle) {
  Polygon p;
  const Vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i) {
      const Vec2 &a = corners[side], &b = corners[(side + 1) % 4];
      double x = a[0] + (b[0] - a[0]) * i / n, y = a[1] + (b[1] - a[1]) * i / n;
      p.push_back({x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle)});
    }
  return p;
}

}  // namespace

TEST_CASE("the side of a line is exact", "[polygon]") {
  // 2^-53 next to the diagonal, where the plain determinant is zero or wrong.
  const double e = std::ldexp(1.0, -53);
  CHECK(orientation({0.5, 0.5}, {12, 12}, {24, 24}) == 0);
  CHECK(orientation({0.5 + e, 0.5}, {12, 12}, {24, 24}) < 0);
  CHECK(orientation({0.5, 0.5 + e}, {12, 12}, {24, 24}) > 0);
  CHECK(orientation({0, 0}, {1, 0}, {0, 1}) == 1);
  CHECK(exact_orientation({0, 0}, {3, 0}, {0, 5}) == 15);
  for (int i = 0; i < 64; ++i)
    for (int k = 0; k < 64; ++k) {
      double x = 0.5 + i * e, y = 0.5 + k * e;
      double sign = orientation({x, y}, {12, 12}, {24, 24});
      CHECK((sign > 0) - (sign < 0) == (y > x) - (y < x));
    }
}

TEST_CASE("simple polygons are cut exactly", "[polygon]") {
  for (std::size_t n : {3, 4, 5, 6, 7, 16, 61, 1000, 20000}) {
    check_simple(regular(n));
    for (unsigned seed = 0; seed < (n < 100 ? 50 : 2); ++seed) check_simple(random_star(n, seed));
  }
  for (std::size_t teeth : {1, 2, 3, 30, 5000}) {
    check_simple(comb(teeth, 0));
    check_simple(comb(teeth, 1));
    check_simple(comb(teeth, -3));
  }
  for (std::size_t n : {300, 20000}) check_simple(spiral(n));
  for (unsigned seed = 0; seed < 30; ++seed) check_simple(maze(2 + int(seed) % 5, seed));
  check_simple(maze(60, 1));
}

TEST_CASE("corners on straight edges become triangles with an area", "[polygon]") {
  check_simple({{0, 0}, {1, 0}, {2, 0}, {0, 2}});
  check_simple({{0, 0}, {1, 0}, {2, 0}, {1, 1}, {0, 2}, {0, 1}});
  check_simple({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 1}});
  check_simple({{0, 0}, {4, 0}, {4, 1}, {3, 1}, {2, 1}, {1, 1}, {0, 1}});
  for (int n : {2, 3, 10, 1000}) check_simple(divided_square(n, 0));
  // Rounded: some corners are reflex by the last bit, others convex by as much. None of the triangles is that thin.
  for (int k = 1; k < 20; ++k) {
    auto p = divided_square(10, 0.1 * k);
    auto c = cut(p);
    CHECK(c.size() == p.size() - 2);
    CHECK(fit(p, c.corners).least > 1e-3);
    CHECK(!c.result.concave);
    CHECK(!c.result.crossing);
  }
}

TEST_CASE("size and place do not matter", "[polygon]") {
  auto p = random_star(50, 7);
  auto same = cut(p).corners;
  for (double size : {std::ldexp(1, -20), std::ldexp(1, 23), std::ldexp(1, -100), std::ldexp(1, 100)}) {
    auto q = p;
    for (auto& v : q) v = {v[0] * size, v[1] * size};
    CHECK(cut(q).corners == same);
  }
  auto far = p;
  for (auto& v : far) v = {v[0] + 1e7, v[1] - 3e6};
  check_simple(far);
  auto shape = maze(4, 3);
  for (auto& v : shape) v = {v[0] * 1e-6 + 1e3, v[1] * 1e-6 - 1e3};
  auto c = cut(shape);
  CHECK(c.size() == shape.size() - 2);
  CHECK(fit(shape, c.corners).area2 == Approx(area2(shape)).epsilon(1e-6));
}

TEST_CASE("polygons in space keep the side they show", "[polygon]") {
  std::mt19937 random(5);
  std::normal_distribution<double> gauss;
  for (int k = 0; k < 50; ++k) {
    Vec3 u{gauss(random), gauss(random), gauss(random)}, v{gauss(random), gauss(random), gauss(random)};
    Vec3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    for (auto& shape : {random_star(12, unsigned(k)), regular(7), maze(3, unsigned(k))}) {
      auto p = in_plane(shape, u, v);
      auto c = cut(p);
      CHECK(c.size() == p.size() - 2);
      CHECK(c.result.planar);
      for (std::size_t t = 0; t < c.corners.size(); t += 3) {
        const Vec3 &a = p[c.corners[t]], &b = p[c.corners[t + 1]], &d = p[c.corners[t + 2]];
        Vec3 x{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, y{d[0] - a[0], d[1] - a[1], d[2] - a[2]};
        CHECK(n[0] * (x[1] * y[2] - x[2] * y[1]) + n[1] * (x[2] * y[0] - x[0] * y[2]) +
                  n[2] * (x[0] * y[1] - x[1] * y[0]) >
              0);
      }
    }
  }
}

TEST_CASE("polygons that are not planar are cut as they look along their normal", "[polygon]") {
  // A gutter around three sides of a square, corners up and down in turn.
  Polygon shape{{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 2}, {2, 2}, {2, 1}, {0, 1}};
  auto p = in_plane(shape);
  for (std::size_t i = 0; i < p.size(); ++i) p[i][2] = i % 2 ? 0.1 : -0.1;
  auto c = cut(p);
  auto f = fit(shape, c.corners);
  CHECK(!c.result.planar);
  CHECK(c.result.concave);
  CHECK(c.size() == 6);
  CHECK(f.area2 == 14);
  CHECK(f.least > 0);
}

TEST_CASE("polygons may touch themselves", "[polygon]") {
  // A hole joined by a bridge whose ends are used twice.
  check_touching({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}}, 8);
  // Two holes on one corner.
  check_touching({{0, 0},
                  {9, 0},
                  {9, 9},
                  {0, 9},
                  {0, 0},
                  {1, 4},
                  {1, 5},
                  {2, 5},
                  {2, 4},
                  {1, 4},
                  {0, 0},
                  {4, 2},
                  {4, 3},
                  {5, 3},
                  {5, 2},
                  {4, 2}},
                 14);
  // Two squares that have a corner in common, which is two polygons and so two triangles less.
  check_touching({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}, 4);
  // A notch whose tip is at a corner, at a corner across, on the edge across. Where it ends between corners, one
  // triangle has its tip in the middle of an edge.
  check_touching({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {0, 0}, {1, 4}, {0, 4}}, 3);
  check_touching({{0, 0}, {2, 0}, {4, 0}, {4, 4}, {3, 4}, {2, 0}, {1, 4}, {0, 4}}, 4);
  check_touching({{0, 0}, {4, 0}, {4, 4}, {3, 4}, {2, 0}, {1, 4}, {0, 4}}, 4);
  // A row of squares, corner to corner, out along one side and back along the other.
  Polygon chain;
  for (double i = 0; i < 50; ++i) chain.insert(chain.end(), {{i, i}, {i + 1, i}});
  for (double i = 50; i > 0; --i) chain.insert(chain.end(), {{i, i}, {i - 1, i}});
  check_touching(chain, 100);
}

TEST_CASE("repeated corners and spikes are cut off", "[polygon]") {
  check_touching({{0, 0}, {0, 0}, {1, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}, 2);
  check_touching({{0, 0}, {1, 0}, {5, 0}, {1, 0}, {1, 1}, {0, 1}}, 2);
  check_touching({{0, 0}, {1, 0}, {2, 3}, {1, 0}, {1, 1}, {0, 1}}, 2);
  check_touching({{0, 0}, {1, 0}, {1, 1}, {1, 9}, {1, 4}, {1, 1}, {0, 1}}, 2);
  Polygon all_twice;
  for (auto& v : maze(5, 1)) all_twice.insert(all_twice.end(), {v, v});
  check_touching(all_twice, all_twice.size() / 2 - 2);
}

TEST_CASE("what has no area leaves nothing", "[polygon]") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  CHECK(cut(Polygon{}).size() == 0);
  CHECK(cut(Polygon{{1, 2}}).size() == 0);
  CHECK(cut(Polygon{{1, 2}, {3, 4}}).size() == 0);
  CHECK(cut(Polygon(7, Vec2{1, 2})).size() == 0);
  CHECK(cut(Polygon{{0, 0}, {1, 1}, {2, 2}, {3, 3}, {7, 7}}).size() == 0);
  CHECK(cut(Polygon{{0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.7, 0.7}, {0.9, 0.9}}).size() == 0);
  CHECK(cut(Polygon{{0, 0}, {1, 0}, {0, 1}, {1, 0}}).size() == 0);
  CHECK(cut(Polygon{{0, 0}, {nan, 0}, {1, 1}, {0, 1}}).size() == 0);
  CHECK(cut(Polygon{{0, 0}, {1, 0}, {1, inf}, {0, 1}}).size() == 0);
  CHECK(cut(Polygon{{0, 0}, {1e300, 0}, {1e300, 1e300}, {0, -1e300}, {-1e300, 7}}).size() <= 3);
}

TEST_CASE("polygons that cross themselves are cut as well as can be", "[polygon]") {
  Polygon pentagram;
  for (int i = 0; i < 5; ++i) pentagram.push_back(regular(5)[2 * i % 5]);
  Polygon twice = regular(16);
  twice.insert(twice.end(), twice.begin(), twice.end());
  Polygon bow_tie{{0, 0}, {1, 1}, {1, 0}, {0, 1}}, uneven{{0, 0}, {3, 3}, {3, 0}, {0, 1}};
  for (auto& p : {pentagram, twice, bow_tie, uneven}) {
    auto c = cut(p);
    CHECK(c.result.crossing);
    CHECK(c.size() > 0);
    CHECK(c.size() <= p.size() - 2);
    CHECK(std::abs(fit(p, c.corners).area2) == Approx(std::abs(area2(p))).margin(1e-12));
  }
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 1);
  for (std::size_t n : {5, 6, 8, 10, 30, 100, 1000, 30000})
    for (int k = 0; k < (n < 50 ? 200 : 2); ++k) {
      Polygon p;
      for (std::size_t i = 0; i < n; ++i) p.push_back({place(random), place(random)});
      if (area2(p) < 0) std::reverse(p.begin(), p.end());
      auto c = cut(p);
      CHECK(c.size() <= n - 2);
      CHECK(fit(p, c.corners).area2 == Approx(area2(p)).margin(1e-9));
    }
}

TEST_CASE("polygons on few points, which touch and cross in every way", "[polygon]") {
  std::mt19937 random(11);
  for (int k = 0; k < 20000; ++k) {
    Polygon p;
    for (std::size_t n = 3 + random() % 10; p.size() < n;) p.push_back({double(random() % 4), double(random() % 4)});
    if (area2(p) < 0) std::reverse(p.begin(), p.end());
    auto c = cut(p);
    REQUIRE(c.size() <= p.size() - 2);
    REQUIRE(fit(p, c.corners).area2 == Approx(area2(p)).margin(1e-12));
  }
}

TEST_CASE("polygons with holes", "[polygon]") {
  // A board with n * n holes, diamonds and triangles in turn, each ring in either direction.
  for (std::size_t n : {0, 1, 2, 7, 20}) {
    std::vector<Vec2> points;
    std::vector<std::uint32_t> ends;
    auto ring = [&](Polygon p, bool reverse) {
      if (reverse) std::reverse(p.begin(), p.end());
      points.insert(points.end(), p.begin(), p.end());
      ends.push_back(static_cast<std::uint32_t>(points.size()));
    };
    double w = static_cast<double>(n), area = 2 * (w + 1) * (w + 1);
    ring({{-1, -1}, {w, -1}, {w, w}, {-1, w}}, n % 2);
    for (std::size_t i = 0; i < n * n; ++i) {
      double x = static_cast<double>(i % n), y = static_cast<double>(i / n);
      Polygon diamond{{x, y - 0.4}, {x + 0.4, y}, {x, y + 0.4}, {x - 0.4, y}},
          triangle{{x, y}, {x + 0.25, y}, {x, y + 0.5}};
      ring(i % 3 ? diamond : triangle, i % 2);
      area -= i % 3 ? 0.64 : 0.125;
    }
    PolygonCutter cutter;
    auto result = cutter.cut(points, ends);
    std::vector<std::uint32_t> corners(cutter.corners().begin(), cutter.corners().end());
    auto f = fit(points, corners);
    CHECK(!result.crossing);
    CHECK(corners.size() / 3 == points.size() + 2 * (ends.size() - 1) - 2);
    CHECK(f.area2 == Approx(area).epsilon(1e-12));
    CHECK(f.least > 0);
    CHECK(f.n_edges_twice == 0);
    CHECK(f.n_boundary == points.size());
  }
}

TEST_CASE("holes that touch their outline, and holes that are none", "[polygon]") {
  PolygonCutter cutter;
  auto area = [&](const std::vector<Vec2>& points, std::vector<std::uint32_t> ends) {
    cutter.cut(points, ends);
    return fit(points, {cutter.corners().begin(), cutter.corners().end()}).area2;
  };
  CHECK(area({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {2, 1}, {1, 2}}, {4, 7}) == 32 - 3);  // at a corner
  CHECK(area({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 2}, {2, 1}, {2, 3}}, {4, 7}) == 32 - 4);  // at an edge
  CHECK(area({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {-3, 2}, {-2, 1}, {-2, 3}}, {4, 7}) == 32);   // outside
  CHECK(area({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {2, 2}}, {4, 6}) == 32);              // of two points
  CHECK(area({{0, 0}, {4, 0}}, {2}) == 0);
  CHECK(area({}, {}) == 0);
}
