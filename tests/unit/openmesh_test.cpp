#include "geometry/simplify/levels.h"
#include "passes/pipeline/pipeline.h"
#include "passes/smooth/smooth.h"
#include "passes/subdivide/subdivide.h"
#include "scenegraph/nodes.h"

#ifdef WRLKIT_OPENMESH
#include "geometry/openmesh/openmesh.h"
#endif

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace wrlkit;

namespace {

/// A mesh pass on one mesh.
struct Bench {
  Scene scene;
  NodeId geometry = scene.add(nodes::IndexedFaceSet);
  Diagnostics diag;
  Statistics stats;
  Task task{diag, stats};
  MeshScratch scratch;

  template <class Options>
  Outcome run(Outcome (*pass)(MeshJob&, const Options&), Mesh& mesh, const Options& options) {
    MeshJob job{scene, geometry, mesh, scratch, task};
    return pass(job, options);
  }
};

Mesh polygons(std::vector<double> points, const std::vector<std::vector<std::uint32_t>>& faces) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  m.positions.edit() = std::move(points);
  m.face_begin.push_back(0);
  for (const auto& f : faces) {
    m.corners.insert(m.corners.end(), f.begin(), f.end());
    m.face_begin.push_back(static_cast<std::uint32_t>(m.corners.size()));
  }
  return m;
}

Mesh cube() {
  return polygons({-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1},
                  {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// n by n squares over the unit square.
template <class Z>
Mesh sheet(std::uint32_t n, Z z) {
  std::vector<double> points;
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const double x = double(i) / n, y = double(j) / n;
      points.insert(points.end(), {x, y, z(x, y)});
      const std::uint32_t a = j * (n + 1) + i;
      if (i < n && j < n) faces.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return polygons(std::move(points), faces);
}

/// A colour, a normal and texture coordinates of its own for each corner; two light coordinates for all.
void decorate(Mesh& m) {
  m.color.width = 4;
  for (std::uint32_t c = 0; c < m.corners.size(); ++c) {
    const auto x = static_cast<float>(c);
    m.color.values.insert(m.color.values.end(), {x, 0.5f, x + 1, 0.25f});
    m.normal.values.insert(m.normal.values.end(), {0, x, 1});
    m.texcoord.values.insert(m.texcoord.values.end(), {x, -x});
    for (Attribute* a : {&m.color, &m.normal, &m.texcoord}) a->index.push_back(c);
    m.lightcoord.index.push_back(c % 2);
  }
  m.lightcoord.values = {0, 1, 1, 0};
}

std::array<double, 2> radii(const Mesh& m) {
  std::array<double, 2> r{1e9, 0};
  for (std::size_t i = 0; i < m.positions.size(); i += 3) {
    const double d = std::hypot(m.positions[i], m.positions[i + 1], m.positions[i + 2]);
    r = {std::min(r[0], d), std::max(r[1], d)};
  }
  return r;
}

double rms_height(const Mesh& m) {
  double sum = 0;
  for (std::size_t i = 2; i < m.positions.size(); i += 3) sum += m.positions[i] * m.positions[i];
  return std::sqrt(sum / static_cast<double>(m.n_positions()));
}

}  // namespace

TEST_CASE("openmesh: a build without it says so") {
  CriterionName criterion;
  const bool built_in = criterion.read("openmesh");
  CHECK(built_in == info(Criterion::openmesh).missing.empty());
  CHECK(CriterionName::fault("openmesh").empty() == built_in);
  CHECK(CriterionName::fault("melax").empty());
  Bench b;
  Mesh m = cube();
  CHECK(b.run(subdivide, m, {}) == (built_in ? Outcome::changed : Outcome::unchanged));
  CHECK(b.diag.count(Diag::verify) == (built_in ? 0 : 1));
  if (built_in) return;
  std::string why;
  CHECK_FALSE(Pipeline::parse("lod{criterion=openmesh}", why));
  CHECK(why.find("built without") != std::string::npos);
}

#ifdef WRLKIT_OPENMESH

TEST_CASE("openmesh: polygons and their corners, there and back") {
  Mesh m = cube();
  decorate(m);
  const auto given = to_openmesh(m);
  CHECK(given.faults.count() == 0);
  CHECK(given.apart.corners.empty());
  CHECK(given.mesh.n_edges() == 12);
  CHECK(given.face_of == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5});
  const Mesh back = from_openmesh(given.mesh);
  CHECK(back.face_begin == m.face_begin);
  REQUIRE(back.corners.size() == m.corners.size());
  for (std::size_t c = 0; c < m.corners.size(); ++c) {
    for (std::size_t k = 0; k < 3; ++k)
      REQUIRE(back.positions[3 * back.corners[c] + k] == m.positions[3 * m.corners[c] + k]);
    for (std::size_t a = 0; a < 4; ++a) {
      const Attribute &x = *std::as_const(m).attributes()[a], &y = *back.attributes()[a];
      REQUIRE(x.width == y.width);
      REQUIRE(std::equal(x.at(x.index[c]), x.at(x.index[c]) + x.width, y.at(y.index[c])));
    }
  }
  CHECK(back.lightcoord.count() == 2);
  CHECK_FALSE(from_openmesh(to_openmesh(m, false).mesh).color.present());
}

TEST_CASE("openmesh: what is no manifold is kept apart") {
  Mesh m = cube();
  auto add = [&](std::vector<std::uint32_t> face) {
    m.corners.insert(m.corners.end(), face.begin(), face.end());
    m.face_begin.push_back(static_cast<std::uint32_t>(m.corners.size()));
  };
  m.positions.edit().insert(m.positions.edit().end(), {5, 5, 5, 6, 6, 6});
  add({0, 1, 8});  // a third face at an edge, and one at a point that is closed
  add({8, 9, 8});
  decorate(m);
  const auto given = to_openmesh(m);
  CHECK(given.faults.edges + given.faults.points == 1);
  CHECK(given.faults.repeated == 1);
  CHECK(given.mesh.n_faces() == 6);
  CHECK(given.apart.n_faces() == 2);
  CHECK(given.apart.corners == std::vector<std::uint32_t>{0, 1, 8, 8, 9, 8});
  CHECK(given.apart.color.at(given.apart.color.index[0])[0] == 24);
  SECTION("passes leave it as it is and say so") {
    Bench b;
    const auto corners = m.corners;
    CHECK(b.run(subdivide, m, {}) == Outcome::unchanged);
    CHECK(b.run(smooth, m, {}) == Outcome::unchanged);
    CHECK(b.diag.count(Diag::verify) == 2);
    CHECK(m.corners == corners);
  }
}

TEST_CASE("openmesh: very many faces at a point") {
  constexpr std::uint32_t n = 100'000;
  std::vector<double> points{0, 0, 1};
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < n; ++i) {
    points.insert(points.end(), {std::cos(6.2831853 * i / n), std::sin(6.2831853 * i / n), 0});
    faces.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  Mesh m = polygons(points, faces);
  const auto given = to_openmesh(m);
  CHECK(given.faults.crowded == n - FaceAdder<OpenMeshPolygons>::most_faces_of_a_point);
  CHECK(given.apart.n_faces() == given.faults.crowded);
  m.face_begin.clear();
  Collapser c(m, {.criterion = Criterion::openmesh});
  c.run_to(1000);
  CHECK(c.mesh().n_faces() == c.n_faces());
}

TEST_CASE("subdivide: a cube becomes nearly a ball") {
  for (auto scheme : {SubdivisionScheme::catmull_clark, SubdivisionScheme::loop}) {
    const bool loop = scheme == SubdivisionScheme::loop;
    Bench b;
    Mesh m = cube();
    CHECK(b.run(subdivide, m, {.scheme = scheme, .levels = 4}) == Outcome::changed);
    CHECK(m.n_faces() == (loop ? 12u * 256 : 24u * 64));
    CHECK(b.stats["subdivide.triangles"] == 12u * 256);
    const auto [least, most] = radii(m);
    CHECK(most / least < (loop ? 1.4 : 1.13));  // 1.73 before
    CHECK(most < 1.2);
    if (!loop) {
      const auto before = most / least;
      CHECK(b.run(subdivide, m, {.scheme = scheme}) == Outcome::changed);
      const auto next = radii(m);
      CHECK(next[1] / next[0] == Approx(before).epsilon(0.01));  // it converges
    }
  }
}

TEST_CASE("subdivide: corner attributes are interpolated, normals are dropped") {
  for (auto scheme : {SubdivisionScheme::catmull_clark, SubdivisionScheme::loop}) {
    Bench b;
    Mesh m = sheet(3, [](double, double) { return 0.0; });
    // Where the picture is the sheet itself, subdivision of the inside of a plane leaves it so along the borders of
    // faces; the first corner of each face is a seam in colour.
    for (std::uint32_t c = 0; c < m.corners.size(); ++c) {
      m.texcoord.index.push_back(m.corners[c]);
      m.color.index.push_back(c % 4 == 0);
      m.normal.index.push_back(0);
    }
    for (std::size_t i = 0; i < m.n_positions(); ++i)
      m.texcoord.values.insert(m.texcoord.values.end(), {float(m.positions[3 * i]), float(m.positions[3 * i + 1])});
    m.color.values = {0, 0, 0, 1, 1, 1};
    m.normal.values = {0, 0, 1};
    CHECK(b.run(subdivide, m, {.scheme = scheme, .levels = 2}) == Outcome::changed);
    CHECK_FALSE(m.normal.present());
    CHECK(b.stats["subdivide.dropped-normals"] == 1);
    REQUIRE(m.texcoord.index.size() == m.corners.size());
    double worst = 0, reds = 0;
    for (std::size_t c = 0; c < m.corners.size(); ++c) {
      const float* t = m.texcoord.at(m.texcoord.index[c]);
      const auto* p = m.positions.data() + std::size_t{3} * m.corners[c];
      worst = std::max({worst, std::abs(t[0] - p[0]), std::abs(t[1] - p[1])});
      reds = std::max(reds, double(m.color.at(m.color.index[c])[0]));
    }
    CHECK(worst < 0.12);  // the corners of the border are cut round
    CHECK(reds == 1);
  }
}

TEST_CASE("subdivide: limits, borders, very many edges at a point") {
  Bench b;
  Mesh m = cube();
  CHECK(b.run(subdivide, m, {.levels = 8, .max_triangles = 1000}) == Outcome::unchanged);
  CHECK(b.diag.count(Diag::too_large) == 1);
  CHECK(b.run(subdivide, m, {.max_triangles = 48}) == Outcome::changed);
  CHECK(b.run(subdivide, m, {.max_triangles = 100}) == Outcome::unchanged);  // 48 and 192: one limit for all

  Mesh flat = sheet(4, [](double, double) { return 0.0; });
  CHECK(b.run(subdivide, flat, {.levels = 2}) == Outcome::changed);
  double low = 1, high = 0;
  for (std::size_t i = 0; i < flat.positions.size(); i += 3) {
    low = std::min(low, flat.positions[i]);
    high = std::max(high, flat.positions[i]);
  }
  CHECK(low == 0);
  CHECK(high == 1);

  std::vector<double> points{0, 0, 1};
  std::vector<std::vector<std::uint32_t>> faces;
  for (std::uint32_t i = 0; i < 200; ++i) {
    points.insert(points.end(), {std::cos(6.2831853 * i / 200), std::sin(6.2831853 * i / 200), 0});
    faces.push_back({0, 1 + i, 1 + (i + 1) % 200});
  }
  Mesh cone = polygons(points, faces);
  cone.face_begin.clear();
  CHECK(b.run(subdivide, cone, {.scheme = SubdivisionScheme::loop}) == Outcome::changed);
  CHECK(cone.n_faces() == 800);
  CHECK(radii(cone)[1] < 1.01);
}

TEST_CASE("smooth: noise on a plane goes, the border stays") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-0.05, 0.05);
  Mesh m = sheet(20, [&](double x, double y) { return x > 0 && x < 1 && y > 0 && y < 1 ? noise(random) : 0.1 * x; });
  for (std::size_t i = 0; i < m.n_positions(); ++i)  // a border in the plane
    if (m.positions[3 * i] == 0 || m.positions[3 * i] == 1 || m.positions[3 * i + 1] == 0 ||
        m.positions[3 * i + 1] == 1)
      m.positions.edit()[3 * i + 2] = 0;
  decorate(m);
  const Mesh before = m;
  Bench b;
  CHECK(b.run(smooth, m, {.iterations = 20}) == Outcome::changed);
  CHECK(rms_height(m) < 0.2 * rms_height(before));
  CHECK(m.face_begin == before.face_begin);
  CHECK(m.color.index == before.color.index);
  CHECK_FALSE(m.normal.present());
  for (std::size_t c = 0; c < m.corners.size(); ++c) {
    const double *p = m.positions.data() + std::size_t{3} * m.corners[c],
                 *q = before.positions.data() + std::size_t{3} * before.corners[c];
    if (q[0] == 0 || q[0] == 1 || q[1] == 0 || q[1] == 1) REQUIRE(std::equal(p, p + 3, q));
  }
}

TEST_CASE("collapse: OpenMesh as a baseline") {
  Mesh m = sheet(20, [](double x, double y) { return 0.05 * std::sin(6 * x + 4 * y); });
  Mesh triangles;
  triangles.kind = Mesh::Kind::faces;
  triangles.positions = m.positions;
  for (std::size_t f = 0; f < m.n_faces(); ++f) {
    const std::uint32_t* q = m.corners.data() + 4 * f;
    const bool left = f % 20 < 10;
    for (int k : {0, 1, 2, 0, 2, 3}) {
      triangles.corners.push_back(q[k]);
      triangles.texcoord.index.push_back(2 * q[k] + left);
    }
  }
  for (std::size_t i = 0; i < m.n_positions(); ++i) {
    const auto x = float(m.positions[3 * i]), y = float(m.positions[3 * i + 1]);
    triangles.texcoord.values.insert(triangles.texcoord.values.end(), {x + 10, y, x, y});
  }
  Collapser c(triangles, {.criterion = Criterion::openmesh});
  for (std::size_t n : {400, 200}) {
    c.run_to(n);
    const Mesh s = c.mesh();
    CHECK(s.n_faces() == c.n_faces());
    CHECK(s.n_faces() <= n);
    REQUIRE(s.texcoord.index.size() == s.corners.size());
    // Every corner is a point of the original with its own place in the picture, of the side that it is on.
    for (std::size_t corner = 0; corner < s.corners.size(); ++corner) {
      const double* p = s.positions.data() + std::size_t{3} * s.corners[corner];
      const float* t = s.texcoord.at(s.texcoord.index[corner]);
      REQUIRE(t[0] - (t[0] > 5 ? 10 : 0) == Approx(p[0]).margin(1e-5));
      REQUIRE(t[1] == Approx(p[1]).margin(1e-5));
      REQUIRE((t[0] > 5 ? p[0] >= 0.5 : p[0] <= 0.5));
    }
  }
  CHECK(c.error() > 0);
  CHECK(c.error() < 0.1);
  CHECK_FALSE(c.next());
  CHECK(c.record().steps.empty());

  Collapser limited(triangles, {.criterion = Criterion::openmesh});
  limited.run_to(0, 0.001);
  CHECK(limited.error() <= 0.001);
  CHECK(limited.n_faces() > 100);
  CHECK(limited.n_faces() < 800);

  Collapser held(triangles, {.criterion = Criterion::openmesh, .fixed = {100, 200, 300}});
  held.run_to(50);
  const Mesh s = held.mesh();
  for (std::size_t i : {100, 200, 300}) {
    bool there = false;
    for (std::size_t k = 0; k < s.n_positions(); ++k)
      there |= std::equal(s.positions.data() + 3 * k, s.positions.data() + 3 * k + 3, m.positions.data() + 3 * i);
    CHECK(there);
  }
}

TEST_CASE("collapse: OpenMesh leaves faces as they are that are no manifold") {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  m.positions.edit() = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  m.corners = {0, 1, 2, 0, 1, 3, 1, 0, 4, 0, 1, 4};
  Collapser c(m, {.criterion = Criterion::openmesh});
  c.run_to(0);
  CHECK(c.mesh().n_faces() == 4);
}

#endif
