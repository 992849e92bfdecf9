// Normals of very many faces, and by their definition.
#include "tests/unit/normals_fixture.h"

using namespace wrlkit;
using namespace wrlkit::normals_tests;

TEST_CASE("normals: what is left alone") {
  Bench b;
  b.set(cube_points(), cube_faces, 0);
  b.run();
  std::vector<float> values = b.mesh.normal.values;
  CHECK(b.run() == Outcome::unchanged);
  CHECK(b.run({.crease_angle = 2}) == Outcome::unchanged);
  CHECK(b.mesh.normal.values == values);
  CHECK(b.run({.recompute = true, .crease_angle = 2}) == Outcome::changed);
  CHECK(b.pairs() == 8);
  b.mesh.primitive = true;
  CHECK(b.run({.recompute = true}) == Outcome::unchanged);
  CHECK(b.pairs() == 8);

  b.set({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, 0);
  b.mesh.kind = Mesh::Kind::lines;
  CHECK(b.run() == Outcome::unchanged);
  CHECK_FALSE(b.mesh.normal.present());
  b.set({}, {}, 1);
  CHECK(b.run() == Outcome::unchanged);
}

TEST_CASE("normals: an apex of 100,000 faces") {
  constexpr std::uint32_t n = 100'000;
  std::vector<Point> points{{0, 1, 0}};
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    double a = 2 * pi * i / n;
    points.push_back({std::cos(a), 0, -std::sin(a)});
    faces.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  Bench b;
  b.set(points, faces, 0.5);
  b.run();
  CHECK(b.pairs() == n + 1);
  check(b.normal(0), {0, 1, 0}, 1e-3);
  check(b.normal(n / 4, 1), unit({0, 1, -1}), 1e-4);
  b.set(points, faces, 1e-5);  // the sides differ by 4.4e-5
  b.run();
  CHECK(b.pairs() == 3 * n);
}

TEST_CASE("normals: an edge of 100,000 faces") {
  constexpr std::uint32_t n = 100'000;
  std::vector<Point> points{{0, 0, 0}, {0, 1, 0}};
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    points.push_back({std::cos(pi * i / n), 0, -std::sin(pi * i / n)});
    faces.push_back({0, 2 + i, 1});
  }
  Bench b;
  b.set(points, faces, 0.5);
  b.run();
  CHECK(b.pairs() == n + 2);
  check(b.normal(0), {1, 0, 0}, 1e-3);
}

TEST_CASE("normals: few positions of very many, very often") {
  constexpr std::size_t n = 10'000'000;
  std::unique_ptr<double[], void (*)(void*)> points(static_cast<double*>(std::calloc(3 * n, sizeof(double))),
                                                    std::free);
  double* p = points.get() + 3 * (n - 4);
  std::vector<Point> corners = hinge(0.5);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) p[3 * i + j] = corners[std::array{0, 1, 3, 4}[i]][j];
  Bench b;
  std::uint32_t k = n - 4;
  for (int i = 0; i < 100'000; ++i) {
    b.mesh.clear();
    b.mesh.kind = Mesh::Kind::faces;
    b.mesh.crease_angle = 1;
    b.mesh.positions = Array<double>::borrow({points.get(), 3 * n});
    b.mesh.corners = {k, k + 1, k + 2, k + 1, k, k + 3};
    b.run();
  }
  CHECK(b.pairs() == 4);
  check(b.normal(2), {0, 0, 1});
}

namespace {

/// Smoothing groups by their definition, every edge against every other, and normals by std::acos.
struct Reference {
  std::vector<std::size_t> group;
  std::vector<Point> normal;

  explicit Reference(const Mesh& m) : group(m.corners.size()), normal(m.corners.size()) {
    for (std::size_t c = 0; c < group.size(); ++c) group[c] = c;
    std::size_t n = m.corners.size();
    for (std::size_t c = 0; c < n; ++c)
      for (std::size_t d = 0; d < c; ++d) {
        std::size_t c2 = c % 3 == 2 ? c - 2 : c + 1, d2 = d % 3 == 2 ? d - 2 : d + 1;
        bool same = m.corners[c] == m.corners[d] && m.corners[c2] == m.corners[d2];
        bool opposite = m.corners[c] == m.corners[d2] && m.corners[c2] == m.corners[d];
        if (!(same || opposite) || !(angle(face(m, c / 3), face(m, d / 3)) < m.crease_angle)) continue;
        unite(c, same ? d : d2);
        unite(c2, same ? d2 : d);
      }
    for (std::size_t c = 0; c < n; ++c) {
      Point sum{};
      for (std::size_t d = 0; d < n; ++d) {
        if (group[d] != group[c]) continue;
        std::size_t f = d / 3 * 3;
        Point o = at(m, d), a = at(m, f + (d + 1) % 3) - o, b = at(m, f + (d + 2) % 3) - o, fn = face(m, d / 3);
        for (int i = 0; i < 3; ++i) sum[i] += angle(unit(a), unit(b)) * fn[i];
      }
      normal[c] = unit(sum);
    }
  }

  static Point at(const Mesh& m, std::size_t c) {
    return {m.positions[3 * m.corners[c]], m.positions[3 * m.corners[c] + 1], m.positions[3 * m.corners[c] + 2]};
  }
  static double angle(const Point& a, const Point& b) {
    return std::acos(std::clamp(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], -1., 1.));
  }
  static Point face(const Mesh& m, std::size_t f) {
    return unit(cross(at(m, 3 * f + 1) - at(m, 3 * f), at(m, 3 * f + 2) - at(m, 3 * f)));
  }
  void unite(std::size_t a, std::size_t b) {
    std::size_t from = group[a], to = group[b];
    for (std::size_t& g : group)
      if (g == from) g = to;
  }
};

}  // namespace

TEST_CASE("normals: agrees with the definition on soups where edges have any number of faces") {
  std::mt19937 random(1);
  auto below = [&](std::uint32_t n) { return random() % n; };
  Bench b;
  std::size_t n_smooth = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<Point> points;
    std::uint32_t n = 5 + below(8);
    for (std::uint32_t i = 0; i < n; ++i)
      points.push_back({below(1000) / 100., below(1000) / 100., below(1000) / 400.});
    std::vector<Face> faces;
    for (std::uint32_t i = 5 + below(20); i > 0; --i) {
      std::uint32_t p = below(n), q = below(n), r = below(n);
      if (p != q && q != r && r != p) faces.push_back({p, q, r});
    }
    b.set(points, faces, 0.2 + below(28) / 10.);
    if (round % 2) b.mesh.face_begin.clear();
    b.run();
    Reference expected(b.mesh);
    for (std::size_t c = 0; c < b.mesh.corners.size(); ++c) {
      CAPTURE(round, c);
      Point a = b.normal(c), e = expected.normal[c];
      n_smooth += expected.group[c] != c;
      for (int i = 0; i < 3; ++i) REQUIRE(std::abs(a[i] - e[i]) < 1e-3);
    }
  }
  CHECK(n_smooth > 1000);
}

TEST_CASE("normals: what came before makes no difference") {
  auto compute = [](Bench& b) {
    b.set(hinge(0.3), triangulated(hinge_faces), 1);
    b.run();
    return std::pair{b.mesh.normal.values, b.mesh.normal.index};
  };
  Bench fresh, used;
  for (double crease : {0., 1., 2.}) {
    used.set(cube_points(), cube_faces, crease);
    used.run();
    used.set(hinge(0.3), hinge_faces, crease);
    used.run();
    CHECK(compute(used) == compute(fresh));
  }
}
