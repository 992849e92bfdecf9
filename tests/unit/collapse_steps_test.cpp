// Collapses of hard surfaces, step by step and back.
#include "tests/unit/collapse_fixture.h"

using namespace wrlkit;
using namespace wrlkit::collapse_tests;

TEST_CASE("collapse: three fins on one edge") {
  // The line along which they meet stays, straight, with three faces on each edge.
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
}

TEST_CASE("collapse: surfaces that are no manifold") {
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

/// The faces of a record after that many steps, forwards or undone from the end, as position and attribute values of
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
