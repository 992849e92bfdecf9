// What collapses cost, and what they keep.
#include "tests/unit/collapse_fixture.h"

using namespace wrlkit;
using namespace wrlkit::collapse_tests;

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
  // The diagonal 0 3 of the side z = 0. The faces of 0 next to that side are at right angles to both faces of the edge:
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
