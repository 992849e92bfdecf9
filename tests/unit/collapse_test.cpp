#include "geometry/simplify/collapse.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

using namespace wrlkit;

namespace {

using Point = std::array<double, 3>;
using Triangle = std::array<std::uint32_t, 3>;
constexpr double pi = std::numbers::pi;
constexpr Criterion engines[] = {Criterion::length_normal, Criterion::melax, Criterion::lindstrom_turk,
                                 Criterion::quadric};

Mesh make(const std::vector<Point>& points, const std::vector<Triangle>& faces) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  for (const Point& p : points) m.positions.edit().insert(m.positions.edit().end(), p.begin(), p.end());
  for (const Triangle& t : faces) m.corners.insert(m.corners.end(), t.begin(), t.end());
  return m;
}

/// Vertex i has bit 0, 1, 2 of i as x, y, z. Each side is cut along the diagonal that goes through vertex 0 or 7, so
/// the sides that meet in 0 have their diagonals there.
Mesh cube() {
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
Mesh torus(std::uint32_t n, std::uint32_t m) {
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
std::map<Edge, int> edges(const Mesh& m) {
  std::map<Edge, int> e;
  for (std::size_t c = 0; c < m.corners.size(); ++c)
    ++e[std::minmax({m.corners[c], m.corners[c % 3 == 2 ? c - 2 : c + 1]})];
  return e;
}
long count_edges(const Mesh& m, int n_faces) {
  auto e = edges(m);
  return std::count_if(e.begin(), e.end(), [&](auto& x) { return x.second == n_faces; });
}
long euler(const Mesh& m) {
  return static_cast<long>(m.n_positions()) - static_cast<long>(edges(m).size()) + static_cast<long>(m.n_faces());
}
Mesh simplified(const Mesh& m, std::size_t n, CollapseOptions o = {}) {
  Collapser c(m, o);
  c.run_to(n);
  return c.mesh();
}
bool same(const Mesh& a, const Mesh& b) {
  auto attribute = [](const Attribute& p, const Attribute& q) { return p.values == q.values && p.index == q.index; };
  return std::ranges::equal(a.positions.span(), b.positions.span()) && a.corners == b.corners &&
         attribute(a.normal, b.normal) && attribute(a.color, b.color) && attribute(a.texcoord, b.texcoord);
}

}  // namespace

TEST_CASE("collapse: formula 1 is length by the cosine of the dihedral angle") {
  CollapseOptions o{.criterion = Criterion::length_normal, .keep_borders = false, .keep_creases = false};
  Collapser c(cube(), o);
  // The diagonal of a side lies between parallel normals: its cost is its length. So it is among the first to go, which
  // is the paper's objection to the formula.
  CHECK(c.cost(0, 3).value() == Approx(std::sqrt(2)));
  // An edge of the cube is between perpendicular faces: the cosine is 0.
  CHECK(std::isinf(c.cost(0, 1).value()));
  // Faces at 60 degrees about an edge of length 2: 2 / cos 60.
  double h = std::sqrt(3) / 2;
  Collapser d(make({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -0.5, h}}, {{0, 1, 2}, {1, 0, 3}}), o);  // all on the border
  CHECK(d.cost(0, 1).value() == Approx(4));
}

TEST_CASE("collapse: formula 2 is length by curvature") {
  CollapseOptions o{.criterion = Criterion::melax, .keep_creases = false};
  Collapser c(cube(), o);
  // The diagonal 0 3 of the side z = 0. The faces of 0 beside that side are at right angles to both faces of the edge:
  // (1 - 0) / 2 = 0.5, times the length.
  CHECK(c.cost(0, 3).value() == Approx(0.5 * std::sqrt(2)));
  // Asymmetric. The edge 1 5 lies between the sides y = 0 and x = 1; vertex 1 has one more face, on z = 0, which
  // vertex 5 has not: perpendicular to both.
  CHECK(c.cost(1, 5).value() == Approx(0.5));
  // A flat sheet costs nothing.
  Collapser flat(sheet(4, 4, [](double, double) { return 0.; }), o);
  CHECK(flat.cost(12, 13).value() == 0);
  // A sheet with a fold at x = 1/2: along the fold each face lies in the plane of one side of the edge; across, not.
  Collapser fold(sheet(4, 4, [](double x, double) { return std::max(0., x - 0.5); }), o);
  CHECK(fold.cost(12, 17).value() == Approx(0).margin(1e-15));
  CHECK(fold.cost(12, 11).value() == Approx(0.25 * (1 - std::sqrt(0.5)) / 2));
  // Out of the plane into the fold costs nothing; the direction matters.
  CHECK(fold.cost(11, 12).value() == Approx(0).margin(1e-15));
}

TEST_CASE("collapse: Lindstrom and Turk's cost is nothing where the surface is flat") {
  Collapser c(sheet(6, 6, [](double x, double y) { return x + 2 * y; }), {});
  CHECK(c.cost(24, 25).value() == Approx(0).margin(1e-12));
}

TEST_CASE("collapse: topology of a closed surface is kept") {
  Mesh m = torus(60, 30);
  REQUIRE(euler(m) == 0);
  for (Criterion criterion : engines)
    for (std::size_t n : {1800, 360, 60, 0}) {
      CAPTURE(int(criterion), n);
      Mesh s = simplified(m, n, {.criterion = criterion});
      CHECK(euler(s) == 0);
      CHECK(count_edges(s, 2) == static_cast<long>(edges(s).size()));
      if (n >= 60)
        CHECK((s.n_faces() <= n && s.n_faces() + 2 > n));
      else
        CHECK(s.n_faces() >= 14);  // no torus has fewer
    }
}

TEST_CASE("collapse: a closed part ends as a tetrahedron") {
  for (Criterion criterion : engines) {
    Mesh s = simplified(cube(), 0, {.criterion = criterion, .keep_creases = false});
    CAPTURE(int(criterion), s.n_faces());
    CHECK(s.n_faces() >= 4);
    CHECK(euler(s) == 2);
  }
}

TEST_CASE("collapse: a series of levels is one run, and runs are equal") {
  Mesh m = torus(40, 20);
  for (Criterion criterion : engines) {
    Collapser c(m, {.criterion = criterion});
    for (std::size_t n : {1200, 1000, 300, 299, 100}) {
      if (n == 1000) c.next();
      c.run_to(n);
      CHECK(same(c.mesh(), simplified(m, n, {.criterion = criterion})));
    }
  }
}

TEST_CASE("collapse: large meshes, in sweeps and then in the exact order") {
  Mesh m = torus(300, 120);  // 36,000 vertices
  for (Criterion criterion : engines) {
    CAPTURE(int(criterion));
    CollapseOptions o{.criterion = criterion, .record = true};
    Collapser c(m, o);
    for (std::size_t n : {60'000, 20'000, 16'384, 16'000, 2'000}) {
      for (int i = 0; i < 3; ++i) {
        auto next = c.next();
        REQUIRE(next);
        c.run_to(c.n_faces() - 1);
        const auto& step = c.record().steps.back();
        CHECK((step.from == next->from && step.to == next->to && step.position == next->position));
      }
      c.run_to(n);
      CHECK((c.n_faces() <= n && c.n_faces() + 2 > n));
      CHECK(euler(c.mesh()) == 0);
    }
    CHECK(same(c.mesh(), simplified(m, 2'000, o)));
    CHECK(c.error() < 0.2);
  }
}

TEST_CASE("collapse: borders keep their shape and their number") {
  // A sheet with a square hole; the border of the hole and the outline are two loops.
  Mesh m = sheet(12, 12, [](double x, double y) { return 0.1 * std::sin(7 * x) * std::cos(5 * y); });
  std::vector<std::uint32_t> corners;
  for (std::size_t f = 0; f < m.n_faces(); ++f) {
    std::size_t i = f / 2 % 12, j = f / 24;
    if (i < 4 || i > 7 || j < 4 || j > 7)
      corners.insert(corners.end(), {m.corners[3 * f], m.corners[3 * f + 1], m.corners[3 * f + 2]});
  }
  m.corners = corners;
  REQUIRE(euler(simplified(m, m.n_faces())) == 0);
  for (Criterion criterion : engines)
    for (std::size_t n : {100, 40}) {
      CAPTURE(int(criterion), n);
      Mesh s = simplified(m, n, {.criterion = criterion});
      CHECK(s.n_faces() <= n);
      CHECK(euler(s) == 0);
      for (auto& [edge, n_faces] : edges(s)) CHECK(n_faces <= 2);
      // The corners of the outline are needed for its area; no vertex of an outline that is straight leaves it.
      double low[2] = {1, 1}, high[2] = {0, 0};
      for (std::size_t v = 0; v < s.n_positions(); ++v)
        for (int i = 0; i < 2; ++i) {
          low[i] = std::min(low[i], s.positions[3 * v + i]);
          high[i] = std::max(high[i], s.positions[3 * v + i]);
        }
      if (criterion != Criterion::length_normal)
        for (int i = 0; i < 2; ++i) {
          CHECK(low[i] == Approx(0).margin(0.02));
          CHECK(high[i] == Approx(1).margin(0.02));
        }
    }
}

TEST_CASE("collapse: a crease stays while there is anything else to take") {
  // A roof, whose ridge runs along y at x = 1/2.
  Mesh m = sheet(20, 20, [](double x, double) { return -2 * std::abs(x - 0.5); });
  for (Criterion criterion : {Criterion::melax, Criterion::lindstrom_turk, Criterion::quadric}) {
    CAPTURE(int(criterion));
    Collapser c(m, {.criterion = criterion});
    c.run_to(8);
    CHECK(c.n_faces() <= 8);
    CHECK(c.error() < 1e-3);
  }
}

namespace {

/// A seam at x = 1/2: the texture coordinates of the left half are x, y, those of the right 3 + x, y. A color for each
/// half.
Mesh with_seam(Mesh m) {
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

}  // namespace

TEST_CASE("collapse: seams stay, and attributes go along") {
  Mesh m = with_seam(sheet(20, 20, [](double x, double y) { return 0.05 * std::sin(6 * x + 4 * y); }));
  for (Criterion criterion : engines)
    for (std::size_t n : {200, 60}) {
      CAPTURE(int(criterion), n);
      Mesh s = simplified(m, n, {.criterion = criterion});
      CHECK(s.n_faces() <= n);
      REQUIRE(s.texcoord.index.size() == s.corners.size());
      REQUIRE(s.color.index.size() == s.corners.size());
      double worst = 0, off_seam = 0;
      for (std::size_t f = 0; f < s.n_faces(); ++f) {
        bool right = s.texcoord.at(s.texcoord.index[3 * f])[0] > 2;
        for (std::size_t c = 3 * f; c < 3 * f + 3; ++c) {
          const float* t = s.texcoord.at(s.texcoord.index[c]);
          const float* color = s.color.at(s.color.index[c]);
          double x = s.positions[3 * s.corners[c]], y = s.positions[3 * s.corners[c] + 1];
          CHECK((t[0] > 2) == right);
          CHECK(color[0] == !right);
          CHECK(color[2] == right);
          worst = std::max({worst, std::abs(t[0] - (right ? 3 : 0) - x), std::abs(t[1] - y)});
          off_seam = std::max(off_seam, right ? 0.5 - x : x - 0.5);
        }
      }
      CHECK(worst < 0.03);     // the coordinates are still those of the place
      CHECK(off_seam < 0.01);  // and the halves still meet where they did
    }
}

TEST_CASE("collapse: normals are interpolated and of unit length; faceted ones are no seams") {
  Mesh m = torus(40, 20);
  for (std::size_t c = 0; c < m.corners.size(); ++c) {
    std::uint32_t p = m.corners[c], i = p / 20, j = p % 20;
    double a = 2 * pi * i / 40, b = 2 * pi * j / 20;
    for (double x : {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)})
      m.normal.values.push_back(float(x));
    m.normal.index.push_back(static_cast<std::uint32_t>(c));
  }
  Mesh s = simplified(m, 200);
  REQUIRE(s.normal.index.size() == s.corners.size());
  CHECK(s.normal.count() == s.n_positions());
  for (std::size_t i = 0; i < s.normal.count(); ++i) {
    const float* n = s.normal.at(static_cast<std::uint32_t>(i));
    CHECK(std::hypot(n[0], n[1], n[2]) == Approx(1).margin(1e-5));
  }
}

TEST_CASE("collapse: surfaces that are no manifold") {
  // Three fins on one edge: the line along which they meet stays, straight, with three faces on each edge.
  std::vector<Point> points;
  std::vector<Triangle> faces;
  constexpr std::uint32_t n = 16;
  for (std::uint32_t i = 0; i <= n; ++i) points.push_back({double(i) / n, 0, 0});
  for (std::uint32_t fin = 0; fin < 3; ++fin) {
    double a = 2 * pi * fin / 3;
    auto at = [&](std::uint32_t i, std::uint32_t j) { return j == 0 ? i : (n + 1) * (1 + fin * 4 + j - 1) + i; };
    for (std::uint32_t j = 1; j <= 4; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        points.push_back({double(i) / n, j * std::cos(a) / 8, j * std::sin(a) / 8});
    for (std::uint32_t j = 0; j < 4; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
        faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      }
  }
  Mesh m = make(points, faces);
  REQUIRE(count_edges(m, 3) == n);
  for (Criterion criterion : engines) {
    CAPTURE(int(criterion));
    Mesh s = simplified(m, 24, {.criterion = criterion});
    CHECK(s.n_faces() <= 24);
    long middle = count_edges(s, 3);
    CHECK(middle >= 1);
    for (auto& [edge, k] : edges(s)) CHECK((k == 1 || k == 2 || k == 3));
    for (auto& [edge, k] : edges(s))
      if (k == 3)
        for (std::uint32_t v : {edge.first, edge.second})
          CHECK(std::hypot(s.positions[3 * v + 1], s.positions[3 * v + 2]) < 1e-6);
  }

  SECTION("two tori that touch in a vertex touch there still") {
    Mesh t = torus(20, 10);
    std::size_t n_points = t.n_positions(), n_corners = t.corners.size();
    for (std::size_t v = 1; v < n_points; ++v)
      for (int i = 0; i < 3; ++i) {
        double x = i == 0 ? 2 * t.positions[0] - t.positions[3 * v] : t.positions[3 * v + i];
        t.positions.edit().push_back(x);
      }
    for (std::size_t c = 0; c < n_corners; c += 3)
      for (int k : {0, 2, 1}) {
        std::uint32_t v = t.corners[c + k];
        t.corners.push_back(v ? static_cast<std::uint32_t>(n_points - 1 + v) : 0);
      }
    for (Criterion criterion : engines) {
      Mesh s = simplified(t, 100, {.criterion = criterion});
      CHECK(s.n_faces() <= 100);
      CHECK(euler(s) == -1);  // 0 + 0, less the vertex that they share
    }
  }

  SECTION("faces wound against each other, doubled faces, faces of a point") {
    Mesh t = torus(20, 10);
    for (std::size_t c = 0; c < t.corners.size(); c += 21) std::swap(t.corners[c], t.corners[c + 1]);
    for (std::size_t c = 0; c < 60; ++c) t.corners.push_back(t.corners[c]);
    t.corners.insert(t.corners.end(), {0, 0, 1});
    for (Criterion criterion : engines) {
      Mesh s = simplified(t, 0, {.criterion = criterion});
      CHECK(s.n_faces() > 0);
      for (std::size_t f = 0; f < s.n_faces(); ++f) {
        const std::uint32_t* v = &s.corners[3 * f];
        CHECK((v[0] != v[1] && v[1] != v[2] && v[2] != v[0]));
      }
    }
  }
}

TEST_CASE("collapse: no face turns over") {
  // A bumpy sheet over the unit square: seen from above no face may show its back. Formula 1 piles up turns of less
  // than 90 degrees, step by step; that is its nature.
  Mesh m = sheet(40, 40, [](double x, double y) { return 0.02 * std::sin(20 * x) * std::sin(17 * y); });
  for (Criterion criterion : {Criterion::melax, Criterion::lindstrom_turk, Criterion::quadric})
    for (std::size_t n : {1000, 300, 100}) {
      CAPTURE(int(criterion), n);
      Mesh s = simplified(m, n, {.criterion = criterion});
      for (std::size_t f = 0; f < s.n_faces(); ++f) {
        auto x = [&](int k, int i) { return s.positions[3 * s.corners[3 * f + k] + i]; };
        CHECK((x(1, 0) - x(0, 0)) * (x(2, 1) - x(0, 1)) - (x(1, 1) - x(0, 1)) * (x(2, 0) - x(0, 0)) > 0);
      }
    }
}

TEST_CASE("collapse: no face lies back on another, on a rough surface") {
  std::uint32_t seed = 1;
  Mesh m = sheet(80, 80, [&](double x, double y) {
    seed = seed * 1664525 + 1013904223;
    return 0.2 * std::sin(5 * x) * std::cos(4 * y) + 0.02 * (seed >> 8) / 0x1p24;
  });
  auto normal = [](const Mesh& r, std::size_t f) {
    auto p = [&](int k) { return &r.positions[r.corners[3 * f + static_cast<std::size_t>(k)] * std::size_t{3}]; };
    const double *a = p(0), *b = p(1), *c = p(2);
    Point u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    Point n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double l = std::hypot(n[0], n[1], n[2]);
    return Point{n[0] / l, n[1] / l, n[2] / l};
  };
  for (Criterion by : {Criterion::lindstrom_turk, Criterion::quadric})
    for (std::size_t n : {6400u, 3000u, 1000u, 300u}) {
      Mesh r = simplified(m, n, {.criterion = by});
      std::map<Edge, Point> first;
      int folds = 0;
      for (std::size_t c = 0; c < r.corners.size(); ++c) {
        const auto a = r.corners[c], b = r.corners[c % 3 == 2 ? c - 2 : c + 1];
        const Point at = normal(r, c / 3);
        auto [other, is_first] = first.try_emplace(std::minmax(a, b), at);
        folds += !is_first && at[0] * other->second[0] + at[1] * other->second[1] + at[2] * other->second[2] < -0.866;
      }
      INFO(static_cast<int>(by) << ' ' << n);
      CHECK(folds == 0);
    }
}

TEST_CASE("collapse: an error bound is kept, and given up for more") {
  Mesh m = torus(60, 30);
  Collapser c(m, {});
  c.run_to(0, 0.01);
  CHECK(c.error() <= 0.01);
  std::size_t n = c.n_faces();
  CHECK(n < m.n_faces() / 2);
  c.run_to(0, 0.02);
  CHECK(c.error() <= 0.02);
  CHECK(c.n_faces() < n);
}

TEST_CASE("collapse: the next step is what is done") {
  for (Criterion criterion : engines) {
    Collapser c(torus(20, 10), {.criterion = criterion, .record = true});
    for (int i = 0; i < 50; ++i) {
      auto next = c.next();
      REQUIRE(next);
      if (criterion == Criterion::melax) CHECK(c.cost(next->from, next->to) == next->cost);
      c.run_to(c.n_faces() - 1);
      const auto& step = c.record().steps.back();
      CHECK((step.from == next->from && step.to == next->to && step.position == next->position));
      CHECK(step.cost == next->cost);
    }
  }
}

namespace {

/// The faces of a record after so many steps, forwards or undone from the end, as position and attribute values of
/// corners.
struct Player {
  const CollapseRecord& r;
  std::vector<std::uint32_t> wedge_of_corner = r.wedge_of_corner, wedge_vertex = r.wedge_vertex;
  std::vector<std::uint32_t> row;
  std::vector<bool> removed = std::vector<bool>(r.wedge_of_corner.size() / 3);
  std::map<std::uint32_t, Point> moved;  // vertices that are not where the mesh has them

  explicit Player(const CollapseRecord& record) : r(record) {
    for (std::uint32_t w = 0; w < wedge_vertex.size(); ++w) row.push_back(w);
  }
  void forward() {
    std::size_t faces = 0, corners = 0, wedges = 0;
    for (const auto& s : r.steps) {
      for (; faces < s.end_of_faces; ++faces) removed[r.removed_faces[faces]] = true;
      for (; wedges < s.end_of_wedges; ++wedges) row[r.wedges[wedges].wedge] = r.wedges[wedges].after;
      for (; corners < s.end_of_corners; ++corners)
        wedge_of_corner[r.corners[corners].corner] = r.corners[corners].after;
      for (std::uint32_t& v : wedge_vertex)
        if (v == s.from) v = s.to;
      moved[s.to] = s.position;
    }
  }
  void back() {
    for (std::size_t i = r.steps.size(); i-- > 0;) {
      const auto& s = r.steps[i];
      std::size_t faces = i ? r.steps[i - 1].end_of_faces : 0, corners = i ? r.steps[i - 1].end_of_corners : 0;
      for (std::size_t k = faces; k < s.end_of_faces; ++k) removed[r.removed_faces[k]] = false;
      for (std::size_t k = s.end_of_corners; k-- > corners;) wedge_of_corner[r.corners[k].corner] = r.corners[k].before;
      moved[s.to] = s.old_to;
      moved[s.from] = s.old_from;
    }
  }
};

}  // namespace

TEST_CASE("collapse: the record does and undoes what was done") {
  Mesh plain = torus(20, 10), seams = with_seam(sheet(12, 12, [](double x, double y) { return x * x + y * y; }));
  for (Criterion criterion : engines)
    for (const Mesh* m : {&plain, &seams}) {
      CAPTURE(int(criterion));
      Collapser c(*m, {.criterion = criterion, .record = true});
      c.run_to(60);
      Mesh s = c.mesh();
      Player p(c.record());
      p.forward();
      std::size_t corner = 0;
      for (std::size_t f = 0; f < m->n_faces(); ++f) {
        if (p.removed[f]) continue;
        for (int k = 0; k < 3; ++k, ++corner) {
          std::uint32_t w = p.wedge_of_corner[3 * f + k], v = p.wedge_vertex[w];
          for (int i = 0; i < 3; ++i) {
            double x = p.moved.count(v) ? p.moved[v][i] : m->positions[3 * v + i];
            REQUIRE(s.positions[3 * s.corners[corner] + i] == x);
          }
          if (m == &seams) {
            const float* t = s.texcoord.at(s.texcoord.index[corner]);
            REQUIRE(t[0] == c.record().values[p.row[w] * c.record().width + 3]);
          }
        }
      }
      CHECK(corner == s.corners.size());
      p.back();
      CHECK(std::count(p.removed.begin(), p.removed.end(), true) == 0);
      CHECK(p.wedge_of_corner == c.record().wedge_of_corner);
      for (auto& [v, x] : p.moved)
        for (int i = 0; i < 3; ++i) CHECK(x[i] == m->positions[3 * v + i]);
    }
}

TEST_CASE("collapse: meshoptimizer as a baseline") {
  Mesh m = with_seam(sheet(20, 20, [](double x, double y) { return 0.05 * std::sin(6 * x + 4 * y); }));
  Collapser c(m, {.criterion = Criterion::meshopt});
  for (std::size_t n : {400, 200}) {
    c.run_to(n);
    Mesh s = c.mesh();
    CHECK(s.n_faces() == c.n_faces());
    CHECK(s.n_faces() <= n);
    CHECK(s.texcoord.index.size() == s.corners.size());
  }
  CHECK_FALSE(c.next());
}

TEST_CASE("collapse: hard input") {
  SECTION("nothing") {
    Collapser c(make({}, {}), {});
    c.run_to(0);
    CHECK(c.mesh().n_faces() == 0);
  }
  SECTION("one triangle stays") {
    CHECK(simplified(make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), 0).n_faces() == 1);
  }
  SECTION("numbers that are not finite") {
    for (double bad : {std::nan(""), HUGE_VAL, 1e300, -1e200}) {
      Mesh m = torus(20, 10);
      m.positions.edit()[100] = bad;
      for (Criterion criterion : engines) CHECK(simplified(m, 50, {.criterion = criterion}).n_faces() >= 50 - 1);
    }
  }
  SECTION("very many faces at one vertex, at one edge") {
    constexpr std::uint32_t n = 20'000;
    std::vector<Point> points{{0, 0, 1}, {0, 0, -1}};
    std::vector<Triangle> cone, fan;
    for (std::uint32_t i = 0; i < n; ++i) {
      double a = 2 * pi * i / n;
      points.push_back({std::cos(a), std::sin(a), 0});
      cone.push_back({0, 2 + i, 2 + (i + 1) % n});
      fan.push_back({0, 1, 2 + i});
    }
    for (Criterion criterion : engines) {
      CHECK(simplified(make(points, cone), 100, {.criterion = criterion}).n_faces() <= 100);
      CHECK(simplified(make(points, fan), 100, {.criterion = criterion}).n_faces() == n);
    }
  }
  SECTION("few positions of very many") {
    Mesh m = cube();
    Mesh far = m;
    far.positions.edit().insert(far.positions.edit().begin(), 3 * 1'000'000, 0.);
    for (std::uint32_t& c : far.corners) c += 1'000'000;
    CHECK(simplified(far, 8).corners.size() == simplified(m, 8).corners.size());
  }
}
