// Surfaces to unwrap, and what holds for any of them.
#pragma once
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

namespace wrlkit::unwrap_tests {

using namespace wrlkit::unwrap;
namespace fs = std::filesystem;

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

inline Solid cube() {
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

inline Triangle2 places(const Charts& c, std::size_t t) {
  Triangle2 r;
  for (std::size_t k = 0; k < 3; ++k) r[k] = {c.places[3 * t + k].x, c.places[3 * t + k].y};
  return r;
}
inline double area(const Triangle2& t) { return cross(t[1] - t[0], t[2] - t[0]) / 2; }

inline double area(const Solid& s, std::size_t t) {
  double a = s.distance(3 * t, 3 * t + 1), b = s.distance(3 * t + 1, 3 * t + 2), c = s.distance(3 * t + 2, 3 * t);
  double h = (a + b + c) / 2;
  return std::sqrt(std::max(0., h * (h - a) * (h - b) * (h - c)));
}

/// The largest relative error of an edge's length.
inline double distortion(const Solid& s, const Charts& c) {
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
inline void check(const Solid& s, const Charts& c) {
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
inline double stretch(const Solid& s, const Charts& c) {
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

inline Point2 turned(Point2 p, int quarters) {
  for (int q = quarters & 3; q > 0; --q) p = {-p.y, p.x};
  return p;
}

inline Texels texels(std::span<const PackItem> items, const Atlas& atlas, int padding) {
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

inline void check(std::span<const PackItem> items, const Atlas& atlas, int padding) {
  REQUIRE(atlas.items.size() == items.size());
  Texels t = texels(items, atlas, padding);
  CHECK(t.shared == 0);
  CHECK(t.outside == 0);
  CHECK(t.too_near == 0);
}

/// Charts that are random fans.
inline Charts random_charts(int n, double size, unsigned seed) {
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

inline bool same(const Placement& a, const Placement& b) {
  return a.page == b.page && a.quarter_turns == b.quarter_turns && a.x == b.x && a.y == b.y && a.scale == b.scale;
}

}  // namespace wrlkit::unwrap_tests
