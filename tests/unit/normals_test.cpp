#include "passes/normals/normals.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <random>
#include <set>

using namespace wrlkit;

namespace {

constexpr double pi = std::numbers::pi;
using Point = Vec3;
using Face = std::vector<std::uint32_t>;

/// One mesh and what the pass needs around it.
struct Bench {
  Scene scene;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  MeshScratch scratch;
  Mesh mesh;

  Outcome run(const NormalsOptions& options = {}) {
    MeshJob job{scene, NodeId{}, mesh, scratch, ctx};
    return normals(job, options);
  }

  void set(const std::vector<Point>& points, const std::vector<Face>& faces, double crease_angle) {
    mesh.clear();
    mesh.kind = Mesh::Kind::faces;
    mesh.crease_angle = crease_angle;
    for (const Point& p : points) mesh.positions.edit().insert(mesh.positions.edit().end(), p.begin(), p.end());
    mesh.face_begin.push_back(0);
    for (const Face& f : faces) {
      mesh.corners.insert(mesh.corners.end(), f.begin(), f.end());
      mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  }

  Point normal(std::size_t corner) const {
    const float* n = mesh.normal.at(mesh.normal.index[corner]);
    return {n[0], n[1], n[2]};
  }
  Point normal(std::size_t face, std::size_t corner) const { return normal(mesh.begin_of(face) + corner); }
  /// What a split into vertices would count.
  std::size_t pairs() const {
    std::set<std::pair<std::uint32_t, std::uint32_t>> s;
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) s.insert({mesh.corners[c], mesh.normal.index[c]});
    return s.size();
  }
  void check_unit() const {
    REQUIRE(mesh.normal.index.size() == mesh.corners.size());
    for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
      Point n = normal(c);
      REQUIRE(std::abs(std::hypot(n[0], n[1], n[2]) - 1) < 1e-6);
    }
  }
};

void check(const Point& a, const Point& b, double margin = 1e-6) {
  CAPTURE(a, b);
  for (int i = 0; i < 3; ++i) CHECK(a[i] == Approx(b[i]).margin(margin));
}

std::vector<Point> cube_points(const Point& centre = {}, double half = 1) {
  std::vector<Point> p;
  for (int i = 0; i < 8; ++i)
    p.push_back(
        {centre[0] + (i & 1 ? half : -half), centre[1] + (i & 2 ? half : -half), centre[2] + (i & 4 ? half : -half)});
  return p;
}
const std::vector<Face> cube_faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
const std::vector<Point> cube_normals{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};

std::vector<Face> triangulated(const std::vector<Face>& faces) {
  std::vector<Face> out;
  for (const Face& f : faces)
    for (std::size_t i = 1; i + 1 < f.size(); ++i) out.push_back({f[0], f[i], f[i + 1]});
  return out;
}

/// Two squares that share the y axis; the second is turned down by `angle` against the first, which has the normal z.
std::vector<Point> hinge(double angle) {
  return {{0, 0, 0},
          {0, 1, 0},
          {-1, 0, 0},
          {-1, 1, 0},
          {std::cos(angle), 0, -std::sin(angle)},
          {std::cos(angle), 1, -std::sin(angle)}};
}
const std::vector<Face> hinge_faces{{0, 1, 3, 2}, {0, 4, 5, 1}};

}  // namespace

TEST_CASE("normals: a cube has 24, 24 and 8 at creaseAngle 0, 1 and 2") {
  Bench b;
  for (double crease : {0., 1.}) {
    b.set(cube_points(), cube_faces, crease);
    CHECK(b.run() == Outcome::changed);
    CHECK(b.pairs() == 24);
    CHECK(b.mesh.normal.count() == 6);
    for (std::size_t c = 0; c < 24; ++c) CHECK(b.normal(c) == cube_normals[c / 4]);
  }
  b.set(cube_points(), cube_faces, 2);
  b.run();
  CHECK(b.pairs() == 8);
  CHECK(b.mesh.normal.count() == 8);
  for (std::size_t c = 0; c < 24; ++c) check(b.normal(c), unit(cube_points()[b.mesh.corners[c]]));
}

TEST_CASE("normals: weights are angles, so that cutting a face changes nothing") {
  Bench b;
  b.set(cube_points(), triangulated(cube_faces), 2);
  b.mesh.face_begin.clear();  // triangles
  b.run();
  CHECK(b.pairs() == 8);
  for (std::size_t c = 0; c < 36; ++c) check(b.normal(c), unit(cube_points()[b.mesh.corners[c]]), 2e-5);

  b.set(cube_points(), triangulated(cube_faces), 1);
  b.run();
  CHECK(b.pairs() == 24);
  CHECK(b.mesh.normal.count() == 6);
  b.mesh.normal.clear();
  b.mesh.crease_angle = 0;
  b.run();
  CHECK(b.pairs() == 24);  // no vertex is split by a normal that is equal
}

TEST_CASE("normals: a cylinder is smooth around and flat on top") {
  constexpr int n = 16;
  std::vector<Point> points;
  std::vector<Face> faces(2);
  for (std::uint32_t i = 0; i < n; ++i) {
    double a = 2 * pi * i / n;
    for (double y : {-1., 1.}) points.push_back({std::cos(a), y, -std::sin(a)});
    std::uint32_t j = (i + 1) % n;
    faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
    faces[0].insert(faces[0].begin(), 2 * i);
    faces[1].push_back(2 * i + 1);
  }
  Bench b;
  b.set(points, faces, 0.5);
  b.run();
  CHECK(b.pairs() == 4 * n);
  for (std::size_t c = 0; c < n; ++c) CHECK(b.normal(0, c) == Point{0, -1, 0});
  for (std::size_t c = 0; c < n; ++c) CHECK(b.normal(1, c) == Point{0, 1, 0});
  for (std::size_t f = 2; f < 2 + n; ++f)
    for (std::size_t c = 0; c < 4; ++c) {
      Point p = points[b.mesh.corners[b.mesh.begin_of(f) + c]];
      check(b.normal(f, c), {p[0], 0, p[2]});
    }

  b.set(points, faces, 0.39);  // the sides differ by 0.3927
  b.run();
  CHECK(b.mesh.normal.count() == n + 2);
  for (std::size_t f = 2; f < 2 + n; ++f) {
    double a = 2 * pi * (f - 2 + 0.5) / n;
    check(b.normal(f, 0), {std::cos(a), 0, -std::sin(a)});
  }
}

TEST_CASE("normals: an edge is smooth below creaseAngle and only there") {
  Bench b;
  for (double angle : {0.001, 0.1, 0.5, 1.5, 3.0}) {
    CAPTURE(angle);
    b.set(hinge(angle), hinge_faces, angle + 1e-5);
    b.run();
    CHECK(b.pairs() == 6);
    for (std::size_t c : {0, 1}) check(b.normal(0, c), {std::sin(angle / 2), 0, std::cos(angle / 2)}, 2e-6);
    check(b.normal(0, 2), {0, 0, 1});
    check(b.normal(1, 1), {std::sin(angle), 0, std::cos(angle)});

    b.set(hinge(angle), hinge_faces, angle - 1e-5);
    b.run();
    CHECK(b.pairs() == 8);
    check(b.normal(0, 0), {0, 0, 1});
    check(b.normal(1, 0), {std::sin(angle), 0, std::cos(angle)});
  }
}

TEST_CASE("normals: faces that touch in one position only are not joined") {
  Bench b;
  b.set({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0.2}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}, 1);
  b.run();
  CHECK(b.pairs() == 6);
}

TEST_CASE("normals: a wall on a floor that is nearly flat") {
  Bench b;
  b.set({{0, 0, 0}, {0, 0, 1}, {-1, -0.1, 0}, {-1, -0.1, 1}, {1, -0.1, 0}, {1, -0.1, 1}, {0, 1, 0}, {0, 1, 1}},
        {{0, 2, 3, 1}, {0, 1, 7, 6}, {0, 1, 5, 4}}, 0.5);
  b.run();
  check(b.normal(0, 0), {0, 1, 0});
  check(b.normal(0, 3), {0, 1, 0});
  check(b.normal(2, 0), {0, 1, 0});
  check(b.normal(2, 1), {0, 1, 0});
  for (std::size_t c = 0; c < 4; ++c) check(b.normal(1, c), {-1, 0, 0});
  CHECK(b.pairs() == 2 * 1 + 4 + 4);
}

TEST_CASE("normals: a sheet that is given for both sides is two smooth sheets") {
  Bench b;
  std::vector<Face> faces = hinge_faces;
  for (const Face& f : hinge_faces) faces.push_back({f.rbegin(), f.rend()});
  faces.push_back(hinge_faces[0]);  // and once more
  b.set(hinge(0.2), faces, 1);
  b.run();
  CHECK(b.pairs() == 2 * 6);
  Point up = unit({std::sin(0.1), 0, std::cos(0.1)});
  check(b.normal(2, 3), {-b.normal(0, 0)[0], 0, -b.normal(0, 0)[2]}, 0.1);
  CHECK(b.normal(0, 0) == b.normal(1, 0));
  CHECK(b.normal(0, 0) == b.normal(4, 0));
  CHECK(b.normal(2, 3) == b.normal(3, 3));
  check(b.normal(2, 3), {-up[0], 0, -up[2]});
}

TEST_CASE("normals: neighbours that are wound against each other meet in a crease") {
  Bench b;
  std::vector<Face> faces{hinge_faces[0], {1, 5, 4, 0}};
  b.set(hinge(0), faces, 3.1415);
  b.run();
  for (std::size_t c = 0; c < 4; ++c) CHECK(b.normal(0, c) == Point{0, 0, 1});
  for (std::size_t c = 0; c < 4; ++c) CHECK(b.normal(1, c) == Point{0, 0, -1});

  b.set(hinge(0), faces, 4);  // smooth, but the sum cancels out: a normal it is all the same
  b.run();
  b.check_unit();
  CHECK(b.pairs() == 6);
  CHECK(b.normal(1, 0) == Point{0, 0, 1});
}

TEST_CASE("normals: a strip of Moebius is smooth but for one crease") {
  constexpr std::uint32_t n = 60;
  std::vector<Point> points;
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    double a = 2 * pi * i / n, r = 0.3;
    for (double s : {-r, r})
      points.push_back(
          {(1 + s * std::cos(a / 2)) * std::cos(a), (1 + s * std::cos(a / 2)) * std::sin(a), s * std::sin(a / 2)});
    if (i + 1 < n) faces.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  faces.push_back({2 * n - 2, 1, 0, 2 * n - 1});
  Bench b;
  b.set(points, faces, 1);
  b.run();
  b.check_unit();
  CHECK(b.pairs() == 2 * n + 2);
  Point before = b.normal(n - 1, 1), after = b.normal(0, 3);  // both at point 1
  double dot = 0;
  for (int i = 0; i < 3; ++i) dot += before[i] * after[i];
  CHECK(dot < -0.98);
}

TEST_CASE("normals: ccw FALSE turns them round, concave corners included") {
  std::vector<Point> points{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}, {1, 0.5, -1}, {0, 2, -1}};
  std::vector<Face> faces{{0, 1, 2, 3, 4}, {4, 3, 5, 6}};
  Bench b;
  b.set(points, faces, 2);
  b.run();
  std::vector<Point> front;
  for (std::size_t c = 0; c < b.mesh.corners.size(); ++c) front.push_back(b.normal(c));
  check(front[0], {0, 0, 1});
  // At point 3 the floor turns by 2 pi - 2 atan(2/3), the wall by pi / 2.
  double reflex = 2 * pi - 2 * std::atan2(1, 1.5), l = std::hypot(1, 1.5);
  check(front[3], unit({1.5 / l * (pi / 2), 1 / l * (pi / 2), reflex}), 1e-4);

  b.set(points, faces, 2);
  b.mesh.ccw = false;
  b.run();
  for (std::size_t c = 0; c < front.size(); ++c) check(b.normal(c), {-front[c][0], -front[c][1], -front[c][2]}, 1e-7);
}

TEST_CASE("normals: faces without area") {
  Bench b;
  SECTION("take the normal of a neighbour, and do not smooth a crease") {
    // The edge 0 1 of a hinge is opened by a triangle 0 8 1 whose corners are in one line.
    std::vector<Point> points = hinge(1);
    points.push_back({0, 0.5, 0});
    b.set(points, {{0, 1, 3, 2}, {0, 4, 5, 1, 6}, {0, 6, 1}}, 0.5);
    b.run();
    b.check_unit();
    for (std::size_t c = 0; c < 4; ++c) check(b.normal(0, c), {0, 0, 1});
    for (std::size_t c = 0; c < 5; ++c) check(b.normal(1, c), {std::sin(1), 0, std::cos(1)});
    CHECK((b.normal(2, 0) == b.normal(0, 0) || b.normal(2, 0) == b.normal(1, 0)));
  }
  SECTION("but for rounding") {
    b.set({{0.1, 0.3, 0.7}, {0.2, 0.6, 1.4}, {0.3, 0.9, 2.1}, {0.7, 2.1, 4.9}}, {{0, 1, 2}, {0, 2, 3}, {3, 1, 0}}, 0.5);
    b.run();
    for (std::size_t c = 0; c < 9; ++c) CHECK(b.normal(c) == Point{0, 0, 1});
  }
  SECTION("have no weight") {
    std::vector<Point> points = hinge(0.4);
    points.push_back({0, 0.5, 0});
    std::vector<Face> faces{{0, 1, 3, 2}, {0, 4, 5, 1, 6}, {0, 6, 1}, {1, 0, 6}, {6, 1, 0}};
    b.set(points, faces, 0.5);
    b.run();
    for (std::size_t c : {0, 1}) check(b.normal(0, c), {std::sin(0.2), 0, std::cos(0.2)}, 2e-6);
    check(b.normal(1, 4), {std::sin(0.4), 0, std::cos(0.4)});
  }
  SECTION("alone have the default") {
    for (double crease : {0., 0.5, 4.}) {
      b.set({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}}, {{0, 1, 2}, {0, 0, 0}, {0, 3, 0, 3}, {0, 1}, {}, {1}},
            crease);
      b.run();
      for (std::size_t c = 0; c < b.mesh.corners.size(); ++c) CHECK(b.normal(c) == Point{0, 0, 1});
    }
  }
  SECTION("numbers that are not finite, or whose squares are not") {
    double nan = std::nan(""), inf = HUGE_VAL;
    for (double crease : {0., 0.5, 4.})
      for (double bad : {nan, inf, -inf, 1e300, 1e-300, 1e160}) {
        std::vector<Point> points = hinge(0.3);
        points[4][1] = bad;
        b.set(points, hinge_faces, crease);
        b.run();
        b.check_unit();
        points = hinge(0.3);
        points[0][2] = bad;
        points[5][2] = -bad;
        b.set(points, hinge_faces, crease);
        b.run();
        b.check_unit();
      }
  }
}

TEST_CASE("normals: the pole of a sphere, whose quadrilaterals have an edge without length") {
  constexpr std::uint32_t n = 12;
  for (bool one_pole : {true, false}) {
    std::vector<Point> points;
    std::vector<Face> faces;
    for (std::uint32_t i = 0; i < n; ++i) {
      double a = 2 * pi * i / n;
      points.push_back({0, 1, 0});
      points.push_back({0.3 * std::cos(a), 0.95, -0.3 * std::sin(a)});
      std::uint32_t j = (i + 1) % n, pole = one_pole ? 0 : 2 * i, next_pole = one_pole ? 0 : 2 * j;
      faces.push_back({pole, 2 * i + 1, 2 * j + 1, next_pole});
    }
    Bench b;
    b.set(points, faces, 1);
    b.run();
    b.check_unit();
    for (std::size_t f = 0; one_pole && f < n; ++f) {
      check(b.normal(f, 0), {0, 1, 0}, 1e-5);
      CHECK(b.normal(f, 0) == b.normal(f, 3));
    }
    Point side = b.normal(0, 2);
    double a = 2 * pi / n;
    CHECK(std::atan2(-side[2], side[0]) == Approx(a).margin(1e-5));
  }
}

TEST_CASE("normals: Newell's of a face that is not planar") {
  Bench b;
  b.set({{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}, {{0, 1, 2, 3}}, 0.5);
  b.run();
  check(b.normal(0), unit({-1, -1, 2}));
  CHECK(b.mesh.normal.count() == 1);
  // The corners of a regular pentagon, lifted: the projected area counts, and the heights cancel out.
  std::vector<Point> points;
  for (int i = 0; i < 5; ++i)
    points.push_back({std::cos(2 * pi * i / 5), std::sin(2 * pi * i / 5), std::cos(4 * pi * i / 5)});
  b.set(points, {{0, 1, 2, 3, 4}}, 0.5);
  b.run();
  check(b.normal(0), {0, 0, 1});
}

TEST_CASE("normals: large coordinates") {
  Bench b;
  Point far{5'000'000.123, -4'000'000.456, 3'000'000.789};
  b.set(cube_points(far, 0.01), cube_faces, 2);
  b.run();
  CHECK(b.pairs() == 8);
  for (std::size_t c = 0; c < 24; ++c) check(b.normal(c), unit(cube_points()[b.mesh.corners[c]]), 1e-6);
}

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
        Point o = at(m, d), a = minus(at(m, f + (d + 1) % 3), o), b = minus(at(m, f + (d + 2) % 3), o),
              fn = face(m, d / 3);
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
