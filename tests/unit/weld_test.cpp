#include "passes/weld/weld.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "passes/triangulate/triangulate.h"
#include "passes/weld/points.h"
#include "scenegraph/nodes.h"

using namespace wrlkit;

namespace {

using Point = std::array<double, 3>;
using Face = std::vector<std::uint32_t>;

/// One mesh and what the pass needs around it.
struct Bench {
  Scene scene;
  NodeId geometry = scene.add(nodes::IndexedFaceSet);
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  MeshScratch scratch;
  Mesh mesh;

  Outcome run(const WeldOptions& options = {}) {
    MeshJob job{scene, geometry, mesh, scratch, ctx};
    return weld(job, options);
  }
  Outcome run(std::string_view tolerance) {
    WeldOptions options;
    REQUIRE(options.tolerance.read(tolerance));
    return run(options);
  }
  std::uint64_t stat(const std::string& name) { return stats.count("weld." + name) ? stats["weld." + name] : 0; }

  void set(const std::vector<Point>& points, const std::vector<Face>& faces) {
    mesh.clear();
    mesh.kind = Mesh::Kind::faces;
    for (const Point& p : points) mesh.positions.edit().insert(mesh.positions.edit().end(), p.begin(), p.end());
    mesh.face_begin.push_back(0);
    for (const Face& f : faces) {
      mesh.corners.insert(mesh.corners.end(), f.begin(), f.end());
      mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    }
  }
  /// The same with points for each face of its own.
  void set_loose(const std::vector<Point>& points, const std::vector<Face>& faces) {
    std::vector<Point> own;
    std::vector<Face> loose;
    for (const Face& f : faces) {
      loose.emplace_back();
      for (auto p : f) {
        loose.back().push_back(static_cast<std::uint32_t>(own.size()));
        own.push_back(points[p]);
      }
    }
    set(own, loose);
  }
  Point at(std::size_t corner) const { return vec3(mesh.positions.data() + std::size_t{3} * mesh.corners[corner]); }
  std::vector<Face> faces() const {
    std::vector<Face> out;
    for (std::size_t f = 0; f < mesh.n_faces(); ++f)
      out.emplace_back(mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.begin_of(f)),
                       mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.end_of(f)));
    return out;
  }
};

/// n x n quadrilaterals in the plane.
std::pair<std::vector<Point>, std::vector<Face>> sheet(std::uint32_t n) {
  std::vector<Point> points;
  std::vector<Face> faces;
  for (std::uint32_t y = 0; y <= n; ++y)
    for (std::uint32_t x = 0; x <= n; ++x) points.push_back({x * 0.25, y * 0.25, 0});
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x) {
      std::uint32_t a = y * (n + 1) + x;
      faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return {points, faces};
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

const std::vector<Point> cube_points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const std::vector<Face> cube{{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

}  // namespace

TEST_CASE("weld joins equal points in the order of their first use") {
  Bench b;
  auto [points, faces] = sheet(20);
  b.set_loose(points, faces);
  REQUIRE(b.run() == Outcome::changed);
  REQUIRE(b.mesh.n_positions() == 21 * 21);
  REQUIRE(b.stat("joined-points") == 4 * 400 - 21 * 21);
  std::uint32_t next = 0;
  for (std::size_t c = 0; c < b.mesh.corners.size(); ++c) {
    REQUIRE(b.mesh.corners[c] <= next);
    next += b.mesh.corners[c] == next;
    REQUIRE(b.at(c) == points[faces[c / 4][c % 4]]);
  }
  REQUIRE(b.run() == Outcome::unchanged);
}

TEST_CASE("weld leaves alone what has nothing to join, shared points included") {
  Bench b;
  auto [points, faces] = sheet(2);
  b.set(points, faces);
  const double* before = b.mesh.positions.data();
  auto corners = b.mesh.corners;
  REQUIRE(b.run() == Outcome::unchanged);
  REQUIRE(b.mesh.positions.data() == before);
  REQUIRE(b.mesh.corners == corners);
  REQUIRE(b.stats.empty());
}

TEST_CASE("weld with a tolerance does what comparing with every point does") {
  Bench b;
  std::mt19937 random(7);
  for (double tolerance : {0.001, 0.02, 0.3, 5.0}) {
    std::uniform_real_distribution<double> where(-1, 1);
    std::vector<Point> points(900);
    for (Point& p : points) p = {where(random), where(random), where(random) * 0.1};
    std::vector<std::uint32_t> index(points.size());
    std::vector<double> flat;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      index[i] = i;
      flat.insert(flat.end(), points[i].begin(), points[i].end());
    }
    PointJoiner joiner;
    StampedMap map;
    joiner.join_equal(flat, index, map);
    joiner.join_near(tolerance, index);
    std::vector<Point> left;
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::size_t n = 0;
      while (n < left.size() && distance(left[n], points[i]) > tolerance) ++n;
      if (n == left.size()) left.push_back(points[i]);
      REQUIRE(index[i] == n);
    }
    REQUIRE(joiner.points.size() == 3 * left.size());
  }
}

TEST_CASE("weld with a tolerance makes no chains") {
  std::vector<Point> points;
  for (int i = 0; i < 100; ++i) points.push_back({i * 0.6, 0, 0});
  std::vector<double> flat;
  std::vector<std::uint32_t> index;
  for (const Point& p : points) {
    index.push_back(static_cast<std::uint32_t>(index.size()));
    flat.insert(flat.end(), p.begin(), p.end());
  }
  PointJoiner joiner;
  StampedMap map;
  joiner.join_equal(flat, index, map);
  joiner.join_near(1, index);
  for (std::uint32_t i = 0; i < index.size(); ++i) REQUIRE(index[i] == i / 2);
}

TEST_CASE("weld finds the sheet again behind the noise of its digits") {
  Bench b;
  auto [points, faces] = sheet(30);
  b.set_loose(points, faces);
  std::mt19937 random(3);
  for (double& v : b.mesh.positions.edit())
    v = std::round((v + 0.0001 * (static_cast<int>(random() % 2))) * 10000) / 10000;
  auto noisy = b.mesh;
  b.run();
  REQUIRE(b.mesh.n_positions() > 31 * 31);
  for (auto tolerance : {"auto", "0.0002"}) {
    b.mesh = noisy;
    b.run(tolerance);
    REQUIRE(b.mesh.n_positions() == 31 * 31);
  }
}

TEST_CASE("the tolerance comes from the digits of the largest coordinates") {
  auto steps = [](std::vector<double> points) { return tolerance_by_digits(points); };
  REQUIRE(steps({0, 0, 0, 12.3456, 1, 2, 0.5, 3.25, 7}) == Approx(1.8e-4));
  REQUIRE(steps({0, 0, 0, 1234.56, 1, 2, 0.000123, 3.25, 7}) == Approx(1.8e-2));  // six digits each
  REQUIRE(steps({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) == 0);                      // a step may be meant
  REQUIRE(steps({0, 0, 0, 0.01, 0, 0, 0.0123, 0.01, 0}) == 0);
  REQUIRE(steps({5000000.123, 0, 0, 5000002.456, 0, 0, 5000002.789, 3, 0}) == Approx(1.8e-3));
  REQUIRE(steps({0, 0, 0, 1.0 / 3, 1, 0, 1, 1, 0}) < 1e-6);
  REQUIRE(steps({1, 1, 1, 1, 1, 1}) == 0);
}

TEST_CASE("weld turns the faces that are wound against the others") {
  Bench b;
  for (bool ccw : {true, false})
    for (std::size_t wrong = 0; wrong < 6; ++wrong) {
      auto faces = cube;
      for (std::size_t f = 0; f < 6; ++f)
        if ((f == wrong) == ccw) std::ranges::reverse(faces[f]);
      b.set_loose(cube_points, faces);
      b.mesh.ccw = ccw;
      b.stats.clear();
      b.run();
      REQUIRE(b.stat("flipped-faces") == 1);
      WeldOptions outward;
      outward.outward = true;
      REQUIRE(b.run(outward) == Outcome::unchanged);
    }
}

TEST_CASE("weld turns half a cube outward, and a whole one on request") {
  Bench b;
  auto faces = cube;
  for (int f : {0, 2, 4}) std::ranges::reverse(faces[static_cast<std::size_t>(f)]);
  b.set_loose(cube_points, faces);
  b.run();
  REQUIRE(b.stat("flipped-faces") == 3);
  WeldOptions outward;
  outward.outward = true;
  REQUIRE(b.run(outward) == Outcome::unchanged);
  b.mesh.ccw = false;
  REQUIRE(b.run() == Outcome::unchanged);
  REQUIRE(b.run(outward) == Outcome::changed);
  REQUIRE(b.stat("flipped-faces") == 9);
}

TEST_CASE("weld leaves a Moebius strip as it is") {
  Bench b;
  std::vector<Point> points;
  std::vector<Face> faces;
  const std::uint32_t n = 12;
  for (std::uint32_t i = 0; i < n; ++i) {
    double a = i * 2 * 3.14159265358979 / n, h = a / 2;
    for (double r : {-0.3, 0.3})
      points.push_back({(1 + r * std::cos(h)) * std::cos(a), (1 + r * std::cos(h)) * std::sin(a), r * std::sin(h)});
    faces.push_back({2 * i, 2 * i + 1, (2 * i + 3) % (2 * n), (2 * i + 2) % (2 * n)});
  }
  faces.back() = {2 * n - 2, 2 * n - 1, 0, 1};
  b.set(points, faces);
  REQUIRE(b.run() == Outcome::unchanged);
  REQUIRE(b.stat("one-sided-parts") == 1);
}

TEST_CASE("weld counts what is not manifold, and keeps it") {
  Bench b;
  std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}};
  b.set(points, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  b.run();
  REQUIRE(b.stat("non-manifold-edges") == 1);
  REQUIRE(b.mesh.n_faces() == 3);
  // Two triangles that touch in a point.
  b.stats.clear();
  b.set({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
  REQUIRE(b.run() == Outcome::unchanged);
  REQUIRE(b.stat("non-manifold-points") == 1);
  REQUIRE(b.stat("non-manifold-edges") == 0);
}

TEST_CASE("weld drops a face that is there already, however it starts; both ways where both sides are seen") {
  Bench b;
  for (bool solid : {true, false}) {
    b.stats.clear();
    b.set(cube_points, {{0, 1, 2, 3}, {2, 3, 0, 1}, {1, 0, 3, 2}, {0, 2, 1, 3}, {0, 1, 2}});
    b.mesh.solid = solid;
    WeldOptions options;
    options.winding = false;
    b.run(options);
    REQUIRE(b.stat("duplicate-faces") == (solid ? 1 : 2));
    REQUIRE(b.mesh.n_faces() == (solid ? 4 : 3));
  }
}

TEST_CASE("weld gives all points on an open edge to its face, in their order") {
  Bench b;
  std::vector<Point> points{{0, 0, 0}, {8, 0, 0}, {0, -1, 0}};
  std::vector<Face> faces{{1, 0, 2}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    auto n = static_cast<std::uint32_t>(points.size());
    double x = (i * 3) % 8;
    points.insert(points.end(), {{x, 0, 0}, {x + 1, 0, 0}, {x + 0.5, 1, 0}});
    faces.push_back({n, n + 1, n + 2});
  }
  b.set(points, faces);
  b.run();
  REQUIRE(b.stat("t-junctions") == 7);
  REQUIRE(b.mesh.end_of(0) == 10);
  for (std::size_t c = 0; c <= 8; ++c) REQUIRE(b.at(c) == Point{8.0 - static_cast<double>(c), 0, 0});
  REQUIRE(b.run() == Outcome::unchanged);
}

TEST_CASE("weld takes a point near an edge only within the tolerance") {
  Bench b;
  std::vector<Point> points{{0, 0, 0}, {4, 0, 0}, {2, -1, 0}, {1, 0.01, 0}, {2, 1, 0}, {0, 1, 0}};
  std::vector<Face> faces{{0, 2, 1}, {3, 4, 5}};
  b.set(points, faces);
  REQUIRE(b.run("0.005") == Outcome::unchanged);
  REQUIRE(b.run("0.02") == Outcome::changed);
  REQUIRE(b.stat("t-junctions") == 1);
}

TEST_CASE("weld is linear where all edges meet in a point, or lie in one place") {
  Bench b;
  const std::uint32_t n = 200000;
  std::vector<Point> points{{0, 0, 0}};
  std::vector<Face> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    points.push_back({std::cos(i * 1e-5), std::sin(i * 1e-5), 0});
    if (i % 2) faces.push_back({0, i, i + 1});
  }
  b.set_loose(points, faces);
  b.run();
  REQUIRE(b.mesh.n_positions() == n + 1);
  b.set_loose(points, faces);
  b.run("0.5");
  REQUIRE(b.mesh.n_positions() <= 5);
}

TEST_CASE("weld unites a sheet to one polygon, and a cube to itself") {
  Bench b;
  auto [points, faces] = sheet(12);
  b.set_loose(points, faces);
  WeldOptions options;
  options.merge_coplanar = true;
  b.run(options);
  REQUIRE(b.faces().size() == 1);
  REQUIRE(b.mesh.corners.size() == 48);
  REQUIRE(b.stat("merged-faces") == 143);
  REQUIRE(b.mesh.convex);
  REQUIRE(b.run(options) == Outcome::unchanged);
  b.set_loose(cube_points, cube);
  MeshJob job{b.scene, b.geometry, b.mesh, b.scratch, b.ctx};
  triangulate(job, {});
  REQUIRE(b.mesh.n_faces() == 12);
  b.run(options);
  REQUIRE(b.mesh.n_faces() == 6);
  REQUIRE(b.mesh.corners.size() == 24);
}

TEST_CASE("the tolerance of weld is a length or auto") {
  WeldTolerance t;
  REQUIRE(t.print() == "0");
  REQUIRE((t.read("0.25") && t.print() == "0.25" && !t.automatic));
  REQUIRE((t.read("auto") && t.print() == "auto"));
  REQUIRE((t.read("1mm") && t.print() == "0.001" && !t.automatic));
  for (auto text : {"", "-1", "nan", "inf", "1 parsec", "Auto"}) REQUIRE(!t.read(text));
}
