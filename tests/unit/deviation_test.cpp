// Surfaces whose distance is known without measuring it.
#include "geometry/deviation.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

using namespace wrlkit;

namespace {

using std::numbers::pi;

struct Surface {
  std::vector<double> positions;
  std::vector<std::uint32_t> corners;

  Triangles view() const { return {positions, corners}; }
  std::uint32_t add(double x, double y, double z) {
    positions.insert(positions.end(), {x, y, z});
    return static_cast<std::uint32_t>(positions.size() / 3 - 1);
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
};

/// n by n squares over [0, size] in x and y, at a height.
template <class Height>
Surface field(int n, double size, Height height, Vec3 origin = {}) {
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      double x = size * i / n, y = size * j / n;
      s.add(origin[0] + x, origin[1] + y, origin[2] + height(x, y));
    }
  auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}

Surface flat(int n, double z, Vec3 origin = {}) {
  return field(
      n, 1, [z](double, double) { return z; }, origin);
}

/// A lathe of `around` by `rings`, closed at the poles by quadrilaterals without one side.
Surface sphere(int around, int rings, double radius) {
  Surface s;
  for (int j = 0; j <= rings; ++j)
    for (int i = 0; i < around; ++i) {
      double a = 2 * pi * i / around, b = pi * j / rings;
      s.add(radius * std::sin(b) * std::cos(a), radius * std::sin(b) * std::sin(a), -radius * std::cos(b));
    }
  auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * around + i % around); };
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < around; ++i) s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}

Deviation between(const Surface& a, const Surface& b, std::size_t samples = 0) {
  return measure_deviation(a.view(), b.view(), {samples});
}

void check_no_deviation(const OneSidedDeviation& d) {
  CHECK(d.rms == 0);
  CHECK(d.max == 0);
  CHECK(d.normal_mean == 0);
  CHECK(d.normal_rms == 0);
  CHECK(d.normal_max == 0);
}

}  // namespace

TEST_CASE("deviation: parallel squares are as far apart as they are") {
  auto d = between(flat(1, 0), flat(7, 0.25));
  for (const OneSidedDeviation* way : std::initializer_list<const OneSidedDeviation*>{&d, &d.forward, &d.backward}) {
    CHECK(way->rms == Approx(0.25).epsilon(1e-12));
    CHECK(way->max == Approx(0.25).epsilon(1e-12));
    CHECK(way->normal_max < 1e-12);
  }
  CHECK((d.where[2] == 0 || d.where[2] == 0.25));
}

TEST_CASE("deviation: equal surfaces deviate by exactly nothing") {
  auto s = sphere(24, 12, 3);
  check_no_deviation(between(s, s));
  // The same triangles in another order, from other corners, of positions of their own.
  Surface loose;
  for (std::size_t i = s.corners.size(); i > 0; i -= 3)
    for (std::size_t k : {2, 0, 1}) {
      const double* p = &s.positions[s.corners[i - 3 + k] * 3];
      loose.corners.push_back(loose.add(p[0], p[1], p[2]));
    }
  check_no_deviation(between(s, loose));
}

TEST_CASE("deviation: the same plane in other triangles is no distance away") {
  auto d = between(flat(3, 0.1), flat(5, 0.1));
  CHECK(d.max < 1e-15);
  CHECK(d.normal_max < 1e-9);
}

TEST_CASE("deviation: a surface that was turned over") {
  auto a = flat(2, 0), b = a;
  for (std::size_t i = 0; i < b.corners.size(); i += 3) std::swap(b.corners[i], b.corners[i + 1]);
  auto d = between(a, b);
  CHECK(d.max < 1e-15);
  CHECK(d.normal_mean == Approx(pi));
  CHECK(d.normal_max == Approx(pi));
}

TEST_CASE("deviation: of two faces on one place that which faces the same way counts") {
  auto sheet = flat(2, 0);
  Surface both_sides = flat(3, 0);
  for (std::size_t i = 0, n = both_sides.corners.size(); i < n; i += 3)
    both_sides.corners.insert(both_sides.corners.end(),
                              {both_sides.corners[i], both_sides.corners[i + 2], both_sides.corners[i + 1]});
  CHECK(between(sheet, both_sides).forward.normal_max < 1e-9);
}

TEST_CASE("deviation: a prism in a cylinder is a sagitta away") {
  constexpr int sides = 12;
  auto lathe = [](int n) {
    Surface s;
    for (int i = 0; i < n; ++i)
      for (double z : {0.0, 1.0}) s.add(2 * std::cos(2 * pi * i / n), 2 * std::sin(2 * pi * i / n), z);
    for (std::uint32_t i = 0, m = static_cast<std::uint32_t>(n); i < m; ++i)
      s.quad(i * 2, (i + 1) % m * 2, (i + 1) % m * 2 + 1, i * 2 + 1);
    return s;
  };
  auto coarse = lathe(sides), fine = lathe(sides * 1024);
  double half = pi / sides, sagitta = 2 * (1 - std::cos(half));
  // From a point of the chord at x from its middle the circle is 2 - sqrt(h^2 + x^2) away, h the height of the chord.
  double h = 2 * std::cos(half), c = 2 * std::sin(half), sum = 0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    double e = 2 - std::hypot(h, (i + 0.5) / n * c);
    sum += e * e / n;
  }
  auto d = between(coarse, fine);
  CHECK(d.forward.rms == Approx(std::sqrt(sum)).epsilon(2e-3));
  CHECK(d.backward.max == Approx(sagitta).epsilon(1e-5));
  CHECK(d.max == Approx(sagitta).epsilon(1e-5));
  CHECK(d.forward.normal_max == Approx(half).epsilon(0.01));
  // The angle is atan(x / h) from the chord, and even along the arc.
  double t = std::tan(half);
  CHECK(d.forward.normal_mean == Approx(half - std::log(1 + t * t) / (2 * t)).epsilon(1e-3));
  CHECK(d.backward.normal_mean == Approx(half / 2).epsilon(1e-3));
}

TEST_CASE("deviation: a sphere against a finer one of the same corners") {
  auto d = between(sphere(32, 16, 1), sphere(32 * 8, 16 * 8, 1));
  // The middle of a quadrilateral at the equator is deepest: two arcs of pi / 16, one across the other. It is cut by a
  // diagonal whose middle is as deep as the chord of both.
  double deepest = 1 - std::cos(std::acos(std::cos(pi / 16) * std::cos(pi / 16)) / 2);
  CHECK(d.max == Approx(deepest).epsilon(0.01));
  CHECK(d.forward.max <= d.max);
  CHECK(d.rms < d.max);
  CHECK(std::hypot(d.where[0], d.where[1], d.where[2]) == Approx(1).margin(deepest));
}

TEST_CASE("deviation: one bump in a plane") {
  constexpr int n = 40;
  auto plane = flat(n, 0);
  auto bumpy = plane;
  constexpr std::uint32_t top = 17 * (n + 1) + 23;
  constexpr double h = 1e-4, cell = 1.0 / n;
  bumpy.positions[top * 3 + 2] = h;
  auto d = between(plane, bumpy);
  // A roof over six triangles: the mean square of its height is h^2 / 6 of their area.
  double area = 6 * cell * cell / 2;
  CHECK(d.max == Approx(h).epsilon(1e-3));
  CHECK(d.backward.max == Approx(h));
  CHECK(d.where == Vec3{bumpy.positions[top * 3], bumpy.positions[top * 3 + 1], h});
  CHECK(d.backward.rms == Approx(h * std::sqrt(area / 6)).epsilon(0.01));
  CHECK(d.forward.rms == Approx(d.backward.rms).epsilon(0.01));
  CHECK(d.normal_max == Approx(std::atan(std::sqrt(2.0) * h / cell)).epsilon(1e-3));
}

TEST_CASE("deviation: a surface that is missing") {
  Surface none;
  auto d = between(flat(1, 0), none);
  CHECK(std::isinf(d.max));
  CHECK(std::isinf(d.rms));
  CHECK(std::isinf(d.forward.max));
  CHECK(d.backward.max == 0);
  CHECK(std::isinf(between(none, flat(1, 0)).backward.max));
  check_no_deviation(between(none, none));
  CHECK(triangles_of(Mesh{}).size() == 0);
}

TEST_CASE("deviation: triangles without area, and without numbers") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  auto plane = flat(4, 0);
  auto worse = plane;
  worse.corners.insert(worse.corners.end(), {0, 0, 0, 0, 1, 1, 0, 1, 2});
  for (double v : {nan, inf, 1e300}) worse.corners.insert(worse.corners.end(), {0, 1, worse.add(0, v, 0)});
  auto d = between(plane, worse);
  CHECK(d.max == 0);
  CHECK(d.normal_max == 0);

  // A triangle that is a segment: from (2 0 1) to (4 0 1), so 2 and 0 ... sqrt(3^2 + 1) away from the square.
  Surface segment;
  segment.corners = {segment.add(2, 0, 1), segment.add(3, 0, 1), segment.add(4, 0, 1)};
  d = between(segment, plane);
  CHECK(d.forward.max == Approx(std::sqrt(10.0)));
  CHECK(d.forward.rms == Approx(std::sqrt((2.0 + 5 + 10) / 3)));
  CHECK(d.backward.max == Approx(std::sqrt(4.0 + 1 + 1)));
  CHECK(d.normal_max == 0);

  Surface point;
  point.corners = {point.add(0.5, 0.5, 3), 0, 0};
  CHECK(between(point, plane).forward.max == Approx(3));

  // A needle with a height of rounding only.
  Surface needle;
  needle.corners = {needle.add(5e6, 0.1, 0), needle.add(5e6 + 1, 0.1, 0), needle.add(5e6 + 0.5, 0.1 + 1e-17, 1e-16)};
  Surface near;
  near.corners = {near.add(5e6 + 0.5, 7.1, 0), 0, 0};
  CHECK(between(near, needle).forward.max == Approx(7));
}

TEST_CASE("deviation: far from the origin it is measured as well") {
  const Vec3 far{5'000'000.123, -3'000'000.456, 7'000.789};
  auto d = between(flat(8, 0, far), flat(5, 0.001, far));
  CHECK(d.rms == Approx(0.001).epsilon(1e-5));
  CHECK(d.max == Approx(0.001).epsilon(1e-5));
  CHECK(d.normal_max < 1e-6);
  check_no_deviation(between(flat(8, 0, far), flat(8, 0, far)));
}

TEST_CASE("deviation: a hundred thousand triangles in one place cost what one does") {
  Surface pile;
  pile.add(0, 0, 0);
  pile.add(1, 0, 0);
  pile.add(0, 1, 0);
  for (int i = 0; i < 100'000; ++i) pile.corners.insert(pile.corners.end(), {0, 1, 2});
  Surface one = pile, above = pile;
  one.corners.resize(3);
  check_no_deviation(between(pile, one));
  for (std::size_t i = 2; i < 9; i += 3) above.positions[i] = 0.5;
  auto d = between(pile, above, 5'000);
  CHECK(d.max == 0.5);
  CHECK(d.rms == Approx(0.5));
}

TEST_CASE("deviation: triangles of sizes that halve make no deep tree") {
  Surface halves;
  for (int i = 0; i < 1000; ++i) {
    double s = std::ldexp(1, -i);
    auto a = halves.add(s, 0, 0);
    halves.add(s, s, 0);
    halves.add(s / 2, 0, s);
    halves.corners.insert(halves.corners.end(), {a, a + 1, a + 2});
  }
  CHECK(ClosestPoint(halves.view()).nearest({-1, 0, 0}, {}).distance == Approx(1));
}

namespace {

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a, ap = p - a;
  const double t = dot(ab, ab) > 0 ? std::clamp(dot(ap, ab) / dot(ab, ab), 0.0, 1.0) : 0;
  const Vec3 off = ap - t * ab;
  return std::sqrt(dot(off, off));
}

/// By the definition, nothing of the program in it: to the plane where the foot lies within all edges, or to an edge.
double to_triangle(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  double least = std::numeric_limits<double>::infinity();
  bool within = dot(n, n) > 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = t[i], &b = t[(i + 1) % 3];
    least = std::min(least, to_segment(p, a, b));
    within = within && dot(cross(b - a, p - a), n) >= 0;
  }
  return within ? std::min(least, std::abs(dot(p - t[0], n)) / std::sqrt(dot(n, n))) : least;
}

Vec3 corner_of(const Surface& s, std::size_t c) {
  const double* p = &s.positions[3 * s.corners[c]];
  return {p[0], p[1], p[2]};
}

double to_every_triangle(const Vec3& p, const Surface& s) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < s.corners.size(); t += 3)
    least = std::min(least, to_triangle(p, {corner_of(s, t), corner_of(s, t + 1), corner_of(s, t + 2)}));
  return least;
}

}  // namespace

TEST_CASE("deviation: the distance to a triangle that is known") {
  const std::array<Vec3, 3> t{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 2, 0}};
  Surface s;
  for (const auto& p : t) s.corners.push_back(s.add(p[0], p[1], p[2]));
  const ClosestPoint surface(s.view());
  const std::pair<Vec3, double> known[] = {{{0.5, 0.5, 3}, 3},           // above it
                                           {{-3, -4, 0}, 5},             // at a corner
                                           {{1, -2, 0}, 2},              // at an edge
                                           {{2, 2, 0}, std::sqrt(2.0)},  // at the long edge
                                           {{2, 2, 1}, std::sqrt(3.0)},  // the same, from above
                                           {{5, 0, 4}, 5}};
  for (const auto& [p, distance] : known) {
    CHECK(surface.nearest(p, {}).distance == Approx(distance));
    CHECK(to_triangle(p, t) == Approx(distance));
  }
}

TEST_CASE("deviation: the nearest point is that of trying every triangle") {
  auto s = sphere(17, 9, 1);
  ClosestPoint all(s.view());
  for (int i = 0; i < 500; ++i) {
    Vec3 p{2 * std::sin(i * 1.1), 2 * std::sin(i * 1.7 + 1), 2 * std::sin(i * 2.3 + 2)};
    CHECK(all.nearest(p, {}).distance == Approx(to_every_triangle(p, s)).epsilon(1e-12).margin(1e-12));
    CHECK(all.nearest(p, {}, static_cast<std::uint32_t>(i % 200)).distance == all.nearest(p, {}).distance);
  }
}

TEST_CASE("deviation: triangles that all pass through one another come to an end, and to the truth") {
  Surface a, b;
  double x = 0.5;
  auto random = [&x] { return x = std::fmod(x * 997 + 0.123, 1); };
  for (Surface* s : {&a, &b})
    for (int i = 0; i < 9'000; ++i) s->corners.push_back(s->add(random(), random(), random()));
  const auto d = between(a, b, 2'000);
  CHECK(std::max(to_every_triangle(d.where, a), to_every_triangle(d.where, b)) == Approx(d.max).epsilon(1e-9));
  for (std::size_t c = 0; c < 9'000; c += 30) {
    CHECK(to_every_triangle(corner_of(a, c), b) <= d.max * (1 + 1e-9));
    CHECK(to_every_triangle(corner_of(b, c), a) <= d.max * (1 + 1e-9));
  }
  CHECK(d.rms < d.max);
  CHECK(d.rms > 0);
}

TEST_CASE("deviation: any number of threads gives the same figures") {
  auto a = sphere(64, 32, 1), b = sphere(50, 20, 1.01);
  auto measured = [&](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return between(a, b, 20'000);
  };
  auto one = measured(1), four = measured(4);
  CHECK(one.rms == four.rms);
  CHECK(one.max == four.max);
  CHECK(one.where == four.where);
  CHECK(one.normal_mean == four.normal_mean);
}
