// Charts: what shapes become, and how much they are stretched.
#include "tests/unit/unwrap_fixture.h"

using namespace wrlkit;
using namespace wrlkit::unwrap_tests;
using namespace wrlkit::unwrap;
namespace fs = std::filesystem;

TEST_CASE("unwrap: a cube is six squares at most") {
  Solid s = cube();
  Charts c = s.charts();
  check(s, c);
  CHECK(c.size() <= 6);
  CHECK(distortion(s, c) < 1e-6);
}

TEST_CASE("unwrap: the side of a cylinder is one rectangle") {
  for (int sides : {6 + 3, 24, 25, 200})
    for (int rings : {1, 2, 7}) {
      double r = 0.3, h = 2;
      Solid s = sheet(sides, rings, true, [&](double u, double v) {
        return P3{r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), h * v};
      });
      Charts c = s.charts();
      check(s, c);
      CHECK(distortion(s, c) < 1e-5);
      REQUIRE(c.size() == 1);
      double around = sides * 2 * r * std::sin(pi / sides);
      CHECK(std::max(c.sizes[0].x, c.sizes[0].y) == Approx(std::max(around, h)).epsilon(1e-4));
      CHECK(std::min(c.sizes[0].x, c.sizes[0].y) == Approx(std::min(around, h)).epsilon(1e-4));
    }
}

TEST_CASE("unwrap: the side of a cone is one sector") {
  int sides = 64;
  double r = 1, h = 2, slant = std::hypot(r, h);
  Solid s;
  for (int i = 0; i < sides; ++i) s.point(r * std::cos(2 * pi * i / sides), r * std::sin(2 * pi * i / sides), 0);
  auto apex = s.point(0, 0, h);
  for (int i = 0; i < sides; ++i) s.triangle(i, (i + 1) % sides, apex);
  Charts c = s.charts();
  check(s, c);
  REQUIRE(c.size() == 1);
  CHECK(distortion(s, c) < 1e-5);
  double angle = 0;
  for (std::size_t t = 0; t < s.size(); ++t) {
    Triangle2 p = places(c, t);
    Point2 u = p[0] - p[2], v = p[1] - p[2];
    angle += std::atan2(cross(u, v), dot(u, v));
  }
  CHECK(angle == Approx(sides * 2 * std::asin(r * std::sin(pi / sides) / slant)).epsilon(1e-6));
}

TEST_CASE("unwrap: a pipe is unrolled to rectangles beside its elbow") {
  // Along the pipe: straight for 2 m, a quarter of a torus, straight for 2 m.
  double r = 0.1, bend = 0.3;
  Solid s = sheet(24, 10, true, [&](double u, double v) {
    int ring = static_cast<int>(std::lround(10 * v));
    double a = ring == 0 ? 0 : ring == 10 ? pi / 2 : (ring - 1) / 8. * pi / 2, d = r * std::cos(2 * pi * u);
    P3 p{(bend + d) * std::cos(a), (bend + d) * std::sin(a), -r * std::sin(2 * pi * u)};
    if (ring == 0) p[1] -= 2;
    if (ring == 10) p[0] -= 2;
    return p;
  });
  Charts c = s.charts();
  check(s, c);
  CHECK(stretch(s, c) < 1.02);
  int rectangles = 0;
  for (Point2f size : c.sizes)
    rectangles += std::abs(size.x - 2) < 1e-4 && std::abs(size.y - 24 * 2 * r * std::sin(pi / 24)) < 1e-4;
  CHECK(rectangles == 2);
}

TEST_CASE("unwrap: the stretch of a sphere is bounded") {
  Solid s = sheet(64, 32, true, [](double u, double v) {
    double a = 2 * pi * u, b = pi * (0.02 + 0.96 * v);
    return P3{std::sin(b) * std::cos(a), std::sin(b) * std::sin(a), -std::cos(b)};
  });
  Charts c = s.charts();
  check(s, c);
  CHECK(c.size() > 1);
  CHECK(c.size() < 40);
  CHECK(stretch(s, c) < 1.02);
}

TEST_CASE("unwrap: what would overlap is cut") {
  // Two and a half turns of a spiral stair, almost flat: laid down, they lie on one another.
  Solid ramp = sheet(100, 1, false, [](double u, double v) {
    double a = 5 * pi * u, r = 1 + 0.5 * v;
    return P3{r * std::cos(a), r * std::sin(a), 0.01 * a};
  });
  Charts c = ramp.charts();
  check(ramp, c);
  CHECK(c.size() > 1);
  CHECK(c.size() < 12);
  // The same turns again and again, exactly.
  Solid exact = sheet(60, 1, false, [](double u, double v) {
    double a = 10 * pi * u, r = 1 + 0.5 * v;
    return P3{r * std::cos(a), r * std::sin(a), 0};
  });
  c = exact.charts();
  check(exact, c);
  CHECK(c.size() >= 5);
}

TEST_CASE("unwrap: a flat grid with a hole is one chart") {
  Solid s = sheet(20, 20, false, [](double u, double v) { return P3{u, v, 0.5 * u}; });
  std::vector<std::uint32_t> kept;
  for (int j = 0; j < 20; ++j)
    for (int i = 0; i < 20; ++i)
      if (i < 5 || i > 9 || j < 5 || j > 12)
        kept.insert(kept.end(), s.corners.begin() + 6 * (20 * j + i), s.corners.begin() + 6 * (20 * j + i) + 6);
  s.corners = kept;
  Charts c = s.charts();
  check(s, c);
  CHECK(c.size() == 1);
  CHECK(distortion(s, c) < 1e-5);
}

TEST_CASE("unwrap: groups are not crossed") {
  Solid s = sheet(4, 4, false, [](double u, double v) { return P3{u, v, 0}; });
  s.groups.assign(s.size(), 7);
  for (std::size_t t = s.size() / 2; t < s.size(); ++t) s.groups[t] = 3;
  Charts c = s.charts();
  check(s, c);
  CHECK(c.size() == 2);
  for (std::size_t t = 0; t < s.size(); ++t) CHECK((c.chart_of[t] == c.chart_of[0]) == (s.groups[t] == 7));
}

TEST_CASE("unwrap: surfaces with one side and edges of many faces have places") {
  Solid moebius;
  int n = 40;
  for (int i = 0; i < n; ++i)
    for (double v : {-0.2, 0.2}) {
      double a = 2 * pi * i / n, r = 1 + v * std::cos(a / 2);
      moebius.point(r * std::cos(a), r * std::sin(a), v * std::sin(a / 2));
    }
  for (std::uint32_t i = 0; i < 40; ++i) {
    bool last = i == 39;
    std::uint32_t a = 2 * i, b = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
    moebius.quad(a, b, d, a + 1);
  }
  Charts c = moebius.charts();
  check(moebius, c);
  CHECK(distortion(moebius, c) < 0.5);

  Solid fan;
  auto low = fan.point(0, 0, 0), high = fan.point(0, 0, 1);
  for (int i = 0; i < 7; ++i) fan.triangle(low, fan.point(std::cos(i), std::sin(i), 0.5), high);
  fan.triangle(low, high, 2);  // and one that is wound the other way
  c = fan.charts();
  check(fan, c);
  CHECK(distortion(fan, c) < 1e-6);
}

TEST_CASE("unwrap: broken triangles have harmless places") {
  Solid s = sheet(3, 3, false, [](double u, double v) { return P3{u, v, 0}; });
  std::size_t good = s.size();
  auto far = s.point(NAN, 0, 0), infinite = s.point(HUGE_VAL, 1, 1), huge = s.point(1e300, 1, 1);
  auto middle = s.point(0.5, 0, 0), same = s.point(0, 0, 0);
  s.triangle(0, 1, far);
  s.triangle(0, 1, infinite);
  s.triangle(1, 2, huge);
  s.triangle(2, 2, 2);
  s.triangle(0, 0, 1);
  s.triangle(0, same, 0);
  s.triangle(0, middle, 1);
  s.triangle(0, 1, 999999);
  Charts c = s.charts();
  check(s, c);
  for (std::size_t t = 0; t < good; ++t) CHECK(c.chart_of[t] == 0);
  for (std::size_t t = good; t < s.size(); ++t) CHECK(std::abs(area(places(c, t))) < 1e-6);
  for (Point2f p : c.places) CHECK((std::isfinite(p.x) && std::isfinite(p.y)));
  CHECK(Solid().charts().size() == 0);
  PackItem item{&c};
  check({&item, 1}, pack({&item, 1}, {.side = 64}), 2);
}

TEST_CASE("unwrap: what a scale has made flat has harmless places") {
  for (int axis = 0; axis < 3; ++axis) {
    Solid s = cube();
    for (std::size_t i = static_cast<std::size_t>(axis); i < s.positions.size(); i += 3) s.positions[i] = 0;
    Charts c = s.charts();
    check(s, c);
    for (Point2f p : c.places) CHECK((std::isfinite(p.x) && std::isfinite(p.y)));
  }
}

TEST_CASE("unwrap: a disc of very many needles") {
  Solid s;
  std::uint32_t n = 10000, middle = s.point(0, 0, 0);
  for (std::uint32_t i = 0; i < n; ++i) s.point(std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0);
  for (std::uint32_t i = 0; i < n; ++i) s.triangle(middle, 1 + i, 1 + (i + 1) % n);
  Charts c = s.charts();
  CHECK(c.size() < 60);
  CHECK(distortion(s, c) < 1e-2);
}

TEST_CASE("unwrap: a million loose corners") {
  Solid s;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (std::uint32_t t = 0; t < 333333; ++t) {
    for (int k = 0; k < 3; ++k) s.point(part(random), part(random), part(random));
    s.triangle(3 * t, 3 * t + 1, 3 * t + 2);
  }
  Charts c = s.charts();
  CHECK(c.size() == s.size());
  CHECK(distortion(s, c) < 1e-2);  // of the thinnest; their places are in single precision
}
