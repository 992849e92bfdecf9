#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <set>
#include <utility>

#include "base/parallel.h"
#include "geometry/unwrap/pack.h"
#include "geometry/unwrap/rows.h"
#include "geometry/unwrap/unfold.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"
#include "tests/unit/skip.h"

using namespace wrlkit;
using namespace wrlkit::unwrap;
namespace fs = std::filesystem;

namespace {

constexpr double pi = 3.14159265358979;

struct Solid {
  std::vector<double> positions;
  std::vector<std::uint32_t> corners, groups;

  std::uint32_t point(double x, double y, double z) {
    positions.insert(positions.end(), {x, y, z});
    return static_cast<std::uint32_t>(positions.size() / 3 - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { corners.insert(corners.end(), {a, b, c}); }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  std::size_t size() const { return corners.size() / 3; }
  Charts charts() const { return unfold({positions, corners, groups}); }
  double distance(std::size_t c, std::size_t d) const {
    const double *p = &positions[3 * corners[c]], *q = &positions[3 * corners[d]];
    return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
  }
};

/// A sheet of n x m quads; f gives the positions. `around`: its last column is joined to the first.
template <class F>
Solid sheet(int n, int m, bool around, F&& f) {
  Solid s;
  int columns = around ? n : n + 1;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < columns; ++i) {
      auto p = f(static_cast<double>(i) / n, static_cast<double>(j) / m);
      s.point(p[0], p[1], p[2]);
    }
  auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * columns + i % columns); };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) s.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
  return s;
}
using P3 = std::array<double, 3>;

Solid cube() {
  Solid s;
  for (int i = 0; i < 8; ++i) s.point(i & 1, i >> 1 & 1, i >> 2 & 1);
  s.quad(0, 2, 3, 1);
  s.quad(4, 5, 7, 6);
  s.quad(0, 1, 5, 4);
  s.quad(2, 6, 7, 3);
  s.quad(0, 4, 6, 2);
  s.quad(1, 3, 7, 5);
  return s;
}

Triangle2 places(const Charts& c, std::size_t t) {
  Triangle2 r;
  for (std::size_t k = 0; k < 3; ++k) r[k] = {c.places[3 * t + k].x, c.places[3 * t + k].y};
  return r;
}
double area(const Triangle2& t) { return cross(t[1] - t[0], t[2] - t[0]) / 2; }

double area(const Solid& s, std::size_t t) {
  double a = s.distance(3 * t, 3 * t + 1), b = s.distance(3 * t + 1, 3 * t + 2), c = s.distance(3 * t + 2, 3 * t);
  double h = (a + b + c) / 2;
  return std::sqrt(std::max(0., h * (h - a) * (h - b) * (h - c)));
}

/// The largest relative error of an edge's length.
double distortion(const Solid& s, const Charts& c) {
  double most = 0;
  for (std::size_t t = 0; t < s.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Triangle2 p = places(c, t);
      Point2 e = p[(k + 1) % 3] - p[k];
      double l = s.distance(3 * t + k, 3 * t + (k + 1) % 3);
      most = std::max(most, std::abs(std::sqrt(dot(e, e)) - l) / l);
    }
  return most;
}

/// Calls f(x, y) for the texels whose middle is in the triangle.
template <class F>
void for_each_texel(const Triangle2& t, F&& f) {
  double y0 = std::min({t[0].y, t[1].y, t[2].y}), y1 = std::max({t[0].y, t[1].y, t[2].y});
  for (int y = static_cast<int>(std::ceil(y0 - 0.5)); y + 0.5 < y1; ++y) {
    double low = HUGE_VAL, high = -HUGE_VAL, at = y + 0.5;
    for (int k = 0; k < 3; ++k) {
      Point2 a = t[k], b = t[(k + 1) % 3];
      if ((a.y <= at) == (b.y <= at)) continue;
      if (a.y > b.y) std::swap(a, b);
      double x = a.x + (b.x - a.x) * (at - a.y) / (b.y - a.y);
      low = std::min(low, x);
      high = std::max(high, x);
    }
    for (int x = static_cast<int>(std::ceil(low - 0.5)); x + 0.5 < high; ++x) f(x, y);
  }
}

/// What holds for any surface.
void check(const Solid& s, const Charts& c) {
  REQUIRE(c.chart_of.size() == s.size());
  REQUIRE(c.places.size() == 3 * s.size());
  REQUIRE(c.begin.size() == c.size() + 1);
  REQUIRE(c.begin.back() == s.size());
  constexpr int side = 702;
  std::vector<std::uint32_t> last(side * side, 0);  // of a texel: 1 + the last chart there
  std::size_t faults = 0, mirrored = 0, outside = 0, twice = 0;
  for (std::uint32_t k = 0; k < c.size(); ++k) {
    double scale = 700 / std::max<double>(1e-30, std::max(c.sizes[k].x, c.sizes[k].y));
    for (std::uint32_t i = c.begin[k]; i < c.begin[k + 1]; ++i) {
      std::uint32_t t = c.triangles[i];
      faults += c.chart_of[t] != k;
      Triangle2 p = places(c, t);
      mirrored += area(p) < -1e-9 * c.sizes[k].x * c.sizes[k].x;
      for (Point2 q : p)
        outside += !(q.x >= 0 && q.y >= 0 && q.x <= c.sizes[k].x * 1.000001f && q.y <= c.sizes[k].y * 1.000001f);
      for_each_texel({scale * p[0], scale * p[1], scale * p[2]},
                     [&](int x, int y) { twice += std::exchange(last.at(y * side + x), k + 1) == k + 1; });
    }
  }
  CHECK(faults == 0);
  CHECK(mirrored == 0);
  CHECK(outside == 0);
  CHECK(twice <= c.size() / 2);  // middles of texels exactly on an edge
}

/// L2 of Sander et al. 2001, scaled to equal areas.
double stretch(const Solid& s, const Charts& c) {
  double a3 = 0, a2 = 0, sum = 0;
  for (std::size_t t = 0; t < s.size(); ++t) {
    Triangle2 p = places(c, t);
    double a = area(s, t), b = area(p);
    if (!(b > 0)) continue;
    auto square = [&](int i, int j) { return s.distance(3 * t + i, 3 * t + j) * s.distance(3 * t + i, 3 * t + j); };
    Point2 u = p[1] - p[0], v = p[2] - p[0];
    double uu = square(0, 1), vv = square(0, 2), uv = (uu + vv - square(1, 2)) / 2;
    sum += a * (dot(v, v) * uu - 2 * dot(u, v) * uv + dot(u, u) * vv) / (4 * b * b) / 2;
    a3 += a;
    a2 += b;
  }
  return std::sqrt(sum / a3 * a2 / a3);
}

/// Which chart touches each texel of the pages, and what is wrong.
struct Texels {
  std::vector<std::vector<std::uint64_t>> owner;
  std::size_t shared = 0, outside = 0, too_near = 0;
};

Point2 turned(Point2 p, int quarters) {
  for (int q = quarters & 3; q > 0; --q) p = {-p.y, p.x};
  return p;
}

Texels texels(std::span<const PackItem> items, const Atlas& atlas, int padding) {
  constexpr std::uint64_t nobody = ~std::uint64_t{0};
  Texels r;
  for (const Page& p : atlas.pages) r.owner.emplace_back(std::size_t(p.width) * p.height, nobody);
  auto own = [&](std::uint32_t page, Point2 middle, std::uint64_t who) {
    int x = static_cast<int>(std::floor(middle.x)), y = static_cast<int>(std::floor(middle.y));
    const Page& p = atlas.pages.at(page);
    if (x < 0 || y < 0 || x >= p.width || y >= p.height) {
      ++r.outside;
      return;
    }
    std::uint64_t& o = r.owner[page][std::size_t(y) * p.width + x];
    r.shared += o != nobody && o != who;
    o = who;
  };
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    const Charts& c = *items[i].charts;
    for (std::uint32_t copy = 0; copy < std::max(1u, items[i].copies); ++copy)
      for (std::size_t t = 0; t < c.chart_of.size(); ++t) {
        Placement chart = atlas.items[i].charts[c.chart_of[t]];
        Placement whole = items[i].copies > 1 ? atlas.items[i].copies[copy] : Placement{chart.page};
        int turns = chart.quarter_turns + whole.quarter_turns;
        Triangle2 p = places(c, t);
        for (Point2& q : p) q = turned(whole.apply(chart.apply(q)), 4 - turns % 4);  // as it was when it was drawn
        std::uint64_t who = (std::uint64_t{i} << 20 | copy) << 32 | c.chart_of[t];
        for_each_touched_row(p, [&](int y, int x0, int x1) {
          for (int x = x0; x <= x1; ++x) own(whole.page, turned({x + 0.5, y + 0.5}, turns), who);
        });
      }
  }
  for (std::size_t page = 0; page < atlas.pages.size(); ++page)
    for (int y = 0, w = atlas.pages[page].width, h = atlas.pages[page].height; y < h; ++y)
      for (int x = 0; x < w; ++x) {
        std::uint64_t who = r.owner[page][std::size_t(y) * w + x];
        if (who == nobody) continue;
        for (int j = y; j <= std::min(h - 1, y + padding); ++j)
          for (int k = std::max(0, x - padding); k <= std::min(w - 1, x + padding); ++k) {
            std::uint64_t other = r.owner[page][std::size_t(j) * w + k];
            r.too_near += other != nobody && other != who;
          }
      }
  return r;
}

void check(std::span<const PackItem> items, const Atlas& atlas, int padding) {
  REQUIRE(atlas.items.size() == items.size());
  Texels t = texels(items, atlas, padding);
  CHECK(t.shared == 0);
  CHECK(t.outside == 0);
  CHECK(t.too_near == 0);
}

/// Charts that are random fans.
Charts random_charts(int n, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.05, 1);
  Charts c;
  for (int k = 0; k < n; ++k) {
    double w = size * part(random), h = size * part(random);
    int sides = 3 + static_cast<int>(random() % 9);
    c.begin.push_back(static_cast<std::uint32_t>(c.triangles.size()));
    auto rim = [&](int i) {
      double a = 2 * pi * (i % sides) / sides;
      return Point2f{static_cast<float>(w / 2 * (1 + std::cos(a))), static_cast<float>(h / 2 * (1 + std::sin(a)))};
    };
    for (int i = 0; i < sides; ++i) {
      c.triangles.push_back(static_cast<std::uint32_t>(c.chart_of.size()));
      c.chart_of.push_back(k);
      for (Point2f p : {Point2f{static_cast<float>(w / 2), static_cast<float>(h / 2)}, rim(i), rim(i + 1)})
        c.places.push_back(p);
    }
    c.sizes.push_back({static_cast<float>(w), static_cast<float>(h)});
  }
  c.begin.push_back(static_cast<std::uint32_t>(c.triangles.size()));
  return c;
}

bool same(const Placement& a, const Placement& b) {
  return a.page == b.page && a.quarter_turns == b.quarter_turns && a.x == b.x && a.y == b.y && a.scale == b.scale;
}

}  // namespace

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

TEST_CASE("unwrap: charts keep their distance") {
  for (int padding : {0, 1, 2, 5})
    for (unsigned seed : {1u, 2u}) {
      Charts c = random_charts(80, 20, seed);
      PackItem item{&c};
      Atlas fitted = pack({&item, 1}, {.padding = padding, .side = 200});
      CHECK(fitted.pages.size() == 1);
      check({&item, 1}, fitted, padding);
      Atlas dense = pack({&item, 1}, {.padding = padding, .max_side = 64});
      CHECK(dense.pages.size() > 1);
      CHECK(dense.factor == 1);
      check({&item, 1}, dense, padding);
    }
}

TEST_CASE("unwrap: turning does not mirror") {
  Charts c = random_charts(200, 10, 3);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {.side = 256});
  std::set<int> turns;
  for (std::size_t t = 0; t < c.chart_of.size(); ++t) {
    const Placement& p = atlas.items[0].charts[c.chart_of[t]];
    Triangle2 before = places(c, t), after{p.apply(before[0]), p.apply(before[1]), p.apply(before[2])};
    CHECK(area(after) == Approx(area(before) * p.scale * p.scale).margin(1e-9));
    turns.insert(p.quarter_turns);
  }
  CHECK(turns.size() > 1);
}

TEST_CASE("unwrap: copies are placed as one piece") {
  Charts a = random_charts(12, 9, 4), b = random_charts(30, 6, 5);
  PackItem items[] = {{&a, 1.5, 7}, {&b, 1, 1}};
  for (int side : {0, 128}) {
    Atlas atlas = pack(items, {.side = side});
    check(items, atlas, 2);
    CHECK(atlas.items[0].copies.size() == 7);
    CHECK(atlas.items[1].copies.empty());
    for (const Placement& p : atlas.items[0].copies) CHECK(p.scale == 1);
    for (const Placement& p : atlas.items[0].charts) CHECK(p.scale == Approx(1.5 * atlas.factor));
  }
}

TEST_CASE("unwrap: what is less than a texel has one") {
  Charts c = random_charts(500, 0.3, 6);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {});
  check({&item, 1}, atlas, 2);
  for (std::uint32_t k = 0; k < c.size(); ++k) {
    // The middle of its box is the middle of a texel.
    Point2 m = atlas.items[0].charts[k].apply({c.sizes[k].x / 2, c.sizes[k].y / 2});
    CHECK(m.x - std::floor(m.x) == Approx(0.5));
    CHECK(m.y - std::floor(m.y) == Approx(0.5));
  }
  // More of them than a page has room for: more pages.
  Charts many = random_charts(3000, 0.3, 7);
  item.charts = &many;
  atlas = pack({&item, 1}, {.side = 64});
  CHECK(atlas.pages.size() > 3);
  check({&item, 1}, atlas, 2);
}

TEST_CASE("unwrap: a chart larger than a page is scaled down") {
  Charts c = random_charts(3, 1000, 8);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {.max_side = 128});
  check({&item, 1}, atlas, 2);
  for (const Page& p : atlas.pages) CHECK((p.width == 128 && p.height <= 128));
}

TEST_CASE("unwrap: one page as small as it can be") {
  Charts c = random_charts(40, 20, 9);
  PackItem item{&c};
  Atlas atlas = pack({&item, 1}, {});
  check({&item, 1}, atlas, 2);
  REQUIRE(atlas.pages.size() == 1);
  double covered = 0;
  for (std::size_t t = 0; t < c.chart_of.size(); ++t) covered += area(places(c, t));
  CHECK(covered > 0.2 * atlas.pages[0].width * atlas.pages[0].height);
  // A strip that is longer than the square of its area is wide.
  Solid bar = sheet(1, 1, false, [](double u, double v) { return P3{300 * u, 2 * v, 0}; });
  c = bar.charts();
  atlas = pack({&item, 1}, {});
  REQUIRE(atlas.pages.size() == 1);
  CHECK((atlas.pages[0].width == 512 && atlas.pages[0].height == 2));
  CHECK(atlas.items[0].charts[0].scale == 1);
}

TEST_CASE("unwrap: more charts in a copy than a page has texels") {
  Charts c = random_charts(200, 3, 10);
  PackItem item{&c, 1, 3};
  for (const PackOptions& options : {PackOptions{.max_side = 16}, PackOptions{.side = 16}}) {
    Atlas atlas = pack({&item, 1}, options);
    CHECK(texels({&item, 1}, atlas, 0).outside == 0);
    CHECK(atlas.pages.size() == 3);
    CHECK(atlas.items[0].crowded);
  }
  CHECK_FALSE(pack({&item, 1}, {.max_side = 256}).items[0].crowded);
}

TEST_CASE("unwrap: nothing to pack") {
  Charts none;
  none.begin = {0};
  PackItem item{&none};
  CHECK(pack({}, {}).items.empty());
  CHECK(pack({&item, 1}, {.side = 64}).items.size() == 1);
  CHECK(pack({&item, 1}, {}).items[0].charts.empty());
}

TEST_CASE("unwrap: the same on any number of threads") {
  Solid s = sheet(60, 30, true, [](double u, double v) {
    double a = 2 * pi * u, b = pi * (0.02 + 0.96 * v), r = 1 + 0.2 * std::sin(5 * a) * std::sin(3 * b);
    return P3{r * std::sin(b) * std::cos(a), r * std::sin(b) * std::sin(a), -r * std::cos(b)};
  });
  std::vector<Atlas> atlases;
  std::vector<Charts> charts;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    charts.push_back(s.charts());
    PackItem item{&charts.back()};
    atlases.push_back(pack({&item, 1}, {.side = 256}));
  }
  CHECK(charts[0].chart_of == charts[1].chart_of);
  for (std::size_t i = 0; i < charts[0].places.size(); ++i)
    REQUIRE((charts[0].places[i].x == charts[1].places[i].x && charts[0].places[i].y == charts[1].places[i].y));
  for (std::size_t k = 0; k < charts[0].size(); ++k)
    CHECK(same(atlases[0].items[0].charts[k], atlases[1].items[0].charts[k]));
}

TEST_CASE("unwrap: scans and parts", "[found]") {
  const char* shared = std::getenv("WRLKIT_SHARED");
  auto folder = (shared ? fs::path(shared) : fs::path(WRLKIT_SOURCE_DIR) / ".." / "shared") / "meshes";
  if (!fs::exists(folder)) {
    return skip("there is no folder " + folder.string() + " (WRLKIT_SHARED)");
  }
  for (std::string name : {"bunny", "fandisk", "flange", "ibeam", "valve", "ellhole452"}) {
    INFO(name);
    Diagnostics diag;
    Statistics stats;
    auto world = read_world((folder / (name + ".wrl.gz")).string(), {}, diag);
    REQUIRE(world);
    PassContext ctx{diag, stats};
    std::string why;
    auto pipeline = Pipeline::parse("weld,triangulate", why);
    MeshSource source = pipeline->run_lazily(world->scene, ctx);
    for (std::uint32_t i = 0; i < world->scene.node_count(); ++i) {
      if (!world->scene.is(NodeId{i}, nodes::X3DGeometryNode)) continue;
      const Mesh& m = source(NodeId{i});
      Solid s;
      s.positions.assign(m.positions.span().begin(), m.positions.span().end());
      s.corners = m.corners;
      Charts c = s.charts();
      check(s, c);
      CHECK(stretch(s, c) < 1.02);
      CHECK(c.size() < s.size() / 50 + 6);
      PackItem item{&c};
      check({&item, 1}, pack({&item, 1}, {.side = 512}), 2);
    }
  }
}
