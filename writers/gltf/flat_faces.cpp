#include "writers/gltf/flat_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace wrlkit::gltf {
namespace {

using Point = std::array<std::int64_t, 3>;
using Edge = std::pair<Point, Point>;
using Vec = std::array<double, 3>;

constexpr double flat = 1e-6;  // height of a triangle, as part of its longest side

Point on_grid(const float* p, double step) {
  Point out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = std::llround(p[k] / step);
  return out;
}

template <class T>
double square_of_cross(const T& a, const T& b, const T& c) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double x = static_cast<double>(b[i] - a[i]) * static_cast<double>(c[j] - a[j]) -
                     static_cast<double>(b[j] - a[j]) * static_cast<double>(c[i] - a[i]);
    sum += x * x;
  }
  return sum;
}

template <class T>
double square(const T& a, const T& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>(a[k] - b[k]) * static_cast<double>(a[k] - b[k]);
  return sum;
}

Edge edge(const Point& a, const Point& b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// The two ends, and what lies between them or on one of them.
struct Flat {
  Point from, to, between;
  std::size_t first;  // corner
};

Flat flat_of(const std::array<Point, 3>& t, std::size_t first) {
  std::size_t far = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (square(t[k], t[(k + 1) % 3]) > square(t[far], t[(far + 1) % 3])) far = k;
  return {t[far], t[(far + 1) % 3], t[(far + 2) % 3], first};
}

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// From a point to a triangle that has an area: its plane, if the point is above the triangle, otherwise the nearest
/// side.
double distance(const Vec& p, const std::array<Vec, 3>& t) {
  const Vec normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool above = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec side = minus(t[(k + 1) % 3], t[k]), to = minus(p, t[k]);
    above &= dot(cross(side, to), normal) >= 0;
    const double along = std::clamp(dot(side, to) / std::max(dot(side, side), 1e-300), 0.0, 1.0);
    const Vec off{to[0] - along * side[0], to[1] - along * side[1], to[2] - along * side[2]};
    nearest = std::min(nearest, dot(off, off));
  }
  return above ? std::abs(dot(minus(p, t[0]), normal)) / std::sqrt(dot(normal, normal)) : std::sqrt(nearest);
}

}  // namespace

bool loses_faces(std::span<const float> xyz, std::span<const std::uint32_t> triangles, double step, double tolerance) {
  auto corner = [&](std::size_t i) { return xyz.data() + std::size_t{triangles[i]} * 3; };
  std::vector<std::size_t> gone;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const std::array<Point, 3> t{on_grid(corner(i), step), on_grid(corner(i + 1), step), on_grid(corner(i + 2), step)};
    if (square_of_cross(t[0], t[1], t[2]) > 0) continue;
    const std::array<std::array<double, 3>, 3> p{{{corner(i)[0], corner(i)[1], corner(i)[2]},
                                                  {corner(i + 1)[0], corner(i + 1)[1], corner(i + 1)[2]},
                                                  {corner(i + 2)[0], corner(i + 2)[1], corner(i + 2)[2]}}};
    const double longest = std::max({square(p[0], p[1]), square(p[1], p[2]), square(p[2], p[0])});
    if (longest > tolerance * tolerance && square_of_cross(p[0], p[1], p[2]) > flat * flat * longest * longest)
      gone.push_back(i);
  }
  if (gone.empty()) return false;
  // Only sides that touch a flat triangle matter.
  std::set<Point> touched;
  std::vector<Flat> open;
  for (auto i : gone) {
    const std::array<Point, 3> t{on_grid(corner(i), step), on_grid(corner(i + 1), step), on_grid(corner(i + 2), step)};
    touched.insert(t.begin(), t.end());
    open.push_back(flat_of(t, i));
  }
  std::set<Edge> covered;
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
    const std::array<Point, 3> t{on_grid(corner(i), step), on_grid(corner(i + 1), step), on_grid(corner(i + 2), step)};
    if (square_of_cross(t[0], t[1], t[2]) == 0) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (touched.contains(t[k]) && touched.contains(t[(k + 1) % 3])) covered.insert(edge(t[k], t[(k + 1) % 3]));
  }
  constexpr int most_rounds = 8;  // slivers beside slivers
  for (int round = 0; round < most_rounds && !open.empty(); ++round) {
    const std::size_t before = open.size();
    std::erase_if(open, [&](const Flat& f) {
      auto has = [&](const Point& a, const Point& b) { return a == b || covered.contains(edge(a, b)); };
      const bool whole = f.from == f.to || has(f.from, f.to),
                 halves = has(f.from, f.between) && has(f.between, f.to) && f.between != f.from && f.between != f.to;
      if (!whole && !halves) return false;
      covered.insert({edge(f.from, f.to), edge(f.from, f.between), edge(f.between, f.to)});
      return true;
    });
    if (open.size() == before) break;
  }
  // What is still open may lie beside another face. A point of each is looked at: the middle.
  constexpr std::size_t most_looked_at = 32;
  for (std::size_t o = 0, by = open.size() / most_looked_at + 1; o < open.size(); o += by) {
    Vec middle{};
    for (std::size_t k = 0; k < 3; ++k)
      middle[k] = (double{corner(open[o].first)[k]} + corner(open[o].first + 1)[k] + corner(open[o].first + 2)[k]) / 3;
    bool near = false;
    for (std::size_t i = 0; i + 2 < triangles.size() && !near; i += 3) {
      std::array<Vec, 3> t;
      bool beside = true;
      for (std::size_t c = 0; c < 3; ++c) {
        const Point p = on_grid(corner(i + c), step);
        for (std::size_t k = 0; k < 3; ++k) t[c][k] = static_cast<double>(p[k]) * step;
      }
      for (std::size_t k = 0; k < 3 && beside; ++k)
        beside = std::min({t[0][k], t[1][k], t[2][k]}) <= middle[k] + tolerance &&
                 std::max({t[0][k], t[1][k], t[2][k]}) >= middle[k] - tolerance;
      near = beside && square_of_cross(t[0], t[1], t[2]) > 0 && distance(middle, t) <= tolerance;
    }
    if (!near) return true;
  }
  return false;
}

}  // namespace wrlkit::gltf
