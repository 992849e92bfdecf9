// Surfaces to simplify.
#pragma once
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "geometry/simplify/collapse.h"

namespace wrlkit::collapse_tests {

using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;
constexpr double pi = std::numbers::pi;
constexpr Criterion engines[] = {Criterion::length_normal, Criterion::melax, Criterion::lindstrom_turk,
                                 Criterion::quadric};

inline Mesh make(const std::vector<Point>& points, const std::vector<Triangle>& faces) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  for (const Point& p : points) m.positions.edit().insert(m.positions.edit().end(), p.begin(), p.end());
  for (const Triangle& t : faces) m.corners.insert(m.corners.end(), t.begin(), t.end());
  return m;
}

/// Vertex i has bit 0, 1, 2 of i as x, y, z. Each side is cut along the diagonal that goes through vertex 0 or 7, so
/// the sides that meet in 0 have their diagonals there.
inline Mesh cube() {
  std::vector<Point> points;
  for (int i = 0; i < 8; ++i) points.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2)});
  return make(points, {{0, 3, 1},
                       {0, 2, 3},
                       {0, 5, 4},
                       {0, 1, 5},
                       {0, 6, 2},
                       {0, 4, 6},
                       {7, 4, 5},
                       {7, 6, 4},
                       {7, 2, 6},
                       {7, 3, 2},
                       {7, 1, 3},
                       {7, 5, 1}});
}

/// n by m squares over the unit square, each of two triangles, lifted to z(x, y).
template <class F>
Mesh sheet(std::uint32_t n, std::uint32_t m, F z) {
  std::vector<Point> points;
  std::vector<Triangle> faces;
  for (std::uint32_t j = 0; j <= m; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      points.push_back({double(i) / n, double(j) / m, z(double(i) / n, double(j) / m)});
  for (std::uint32_t j = 0; j < m; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      std::uint32_t a = j * (n + 1) + i, c = a + n + 1;
      faces.push_back({a, a + 1, c + 1});
      faces.push_back({a, c + 1, c});
    }
  return make(points, faces);
}

/// A torus with bumps, n rings of m; closed, Euler characteristic 0.
inline Mesh torus(std::uint32_t n, std::uint32_t m) {
  std::vector<Point> points;
  std::vector<Triangle> faces;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < m; ++j) {
      double a = 2 * pi * i / n, b = 2 * pi * j / m, r = 0.4 + 0.05 * std::sin(5 * a) * std::cos(3 * b);
      points.push_back({(1 + r * std::cos(b)) * std::cos(a), (1 + r * std::cos(b)) * std::sin(a), r * std::sin(b)});
      std::uint32_t i1 = (i + 1) % n, j1 = (j + 1) % m;
      faces.push_back({i * m + j, i1 * m + j, i1 * m + j1});
      faces.push_back({i * m + j, i1 * m + j1, i * m + j1});
    }
  return make(points, faces);
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;
inline std::map<Edge, int> edges(const Mesh& m) {
  std::map<Edge, int> e;
  for (std::size_t c = 0; c < m.corners.size(); ++c)
    ++e[std::minmax({m.corners[c], m.corners[c % 3 == 2 ? c - 2 : c + 1]})];
  return e;
}
inline long count_edges(const Mesh& m, int n_faces) {
  auto e = edges(m);
  return std::count_if(e.begin(), e.end(), [&](auto& x) { return x.second == n_faces; });
}
inline long euler(const Mesh& m) {
  return static_cast<long>(m.n_positions()) - static_cast<long>(edges(m).size()) + static_cast<long>(m.n_faces());
}
inline Mesh simplified(const Mesh& m, std::size_t n, CollapseOptions o = {}) {
  Collapser c(m, o);
  c.run_to(n);
  return c.mesh();
}
inline bool same(const Mesh& a, const Mesh& b) {
  auto attribute = [](const Attribute& p, const Attribute& q) { return p.values == q.values && p.index == q.index; };
  return std::ranges::equal(a.positions.span(), b.positions.span()) && a.corners == b.corners &&
         attribute(a.normal, b.normal) && attribute(a.color, b.color) && attribute(a.texcoord, b.texcoord);
}

/// A seam at x = 1/2: the texture coordinates of the left half are x, y, those of the right 3 + x, y. A color for each
/// half.
inline Mesh with_seam(Mesh m) {
  for (std::size_t c = 0; c < m.corners.size(); ++c) {
    std::size_t f = c / 3;
    double middle = 0;
    for (int k = 0; k < 3; ++k) middle += m.positions[3 * m.corners[3 * f + k]] / 3;
    bool right = middle > 0.5;
    float x = static_cast<float>(m.positions[3 * m.corners[c]]),
          y = static_cast<float>(m.positions[3 * m.corners[c] + 1]);
    m.texcoord.values.insert(m.texcoord.values.end(), {right ? 3 + x : x, y});
    m.texcoord.index.push_back(static_cast<std::uint32_t>(c));
    m.color.index.push_back(right);
  }
  m.color.values = {1, 0, 0, 0, 0, 1};
  return m;
}

}  // namespace wrlkit::collapse_tests
