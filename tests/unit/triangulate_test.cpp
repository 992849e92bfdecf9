// Pass `triangulate`: faces become triangles, with their attributes, and what cannot is counted.
#include "passes/triangulate/triangulate.h"

#include <catch2/catch.hpp>
#include <set>

#include "scenegraph/nodes.h"

using namespace wrlkit;

namespace {

struct Job {
  Scene scene;
  NodeId geometry = scene.add(nodes::IndexedFaceSet);
  Mesh mesh;
  MeshScratch scratch;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};

  Outcome run() {
    MeshJob job{scene, geometry, mesh, scratch, ctx};
    return triangulate(job, {});
  }
};

using Indices = std::vector<std::uint32_t>;

/// Faces over points, as VRML writes them.
void faces(Job& job, const std::vector<Vec3>& points, const std::vector<int>& coordIndex) {
  auto& mesh = job.mesh;
  mesh.clear();
  mesh.kind = Mesh::Kind::faces;
  for (auto& p : points) mesh.positions.edit().insert(mesh.positions.edit().end(), p.begin(), p.end());
  mesh.face_begin = {0};
  for (int i : coordIndex)
    if (i >= 0)
      mesh.corners.push_back(std::uint32_t(i));
    else
      mesh.face_begin.push_back(std::uint32_t(mesh.corners.size()));
}

const std::vector<Vec3> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}, {1, 0, 0}, {0.5, 0.5, 0}};

}  // namespace

TEST_CASE("faces become triangles in their order", "[triangulate]") {
  Job job;
  faces(job, square, {0, 1, 2, 3, -1, 2, 1, 0, -1, 0, 5, 1, 2, 3, -1});
  CHECK(job.run() == Outcome::changed);
  CHECK(job.mesh.is_triangles());
  CHECK(job.mesh.n_faces() == 2 + 1 + 3);
  CHECK(Indices(job.mesh.corners.begin(), job.mesh.corners.begin() + 9) == Indices{0, 1, 2, 0, 2, 3, 2, 1, 0});
  CHECK(job.diag.messages().empty());
  CHECK(job.stats.empty());
  CHECK(job.run() == Outcome::unchanged);
}

TEST_CASE("attributes go along with their corners", "[triangulate]") {
  Job job;
  faces(job, square, {0, 1, 2, 3, -1, 0, 0, 0, -1, 3, 4, 2, 1, 0, -1, 0, 1, 4, -1});
  auto& mesh = job.mesh;
  // Values that tell which corner they belong to.
  for (std::uint32_t i = 0; i < mesh.corners.size(); ++i) {
    mesh.normal.index.push_back(100 * i + mesh.corners[i]);
    mesh.texcoord.index.push_back(1000 * i + mesh.corners[i]);
  }
  auto faces_of = mesh.face_begin;
  job.run();
  REQUIRE(mesh.n_faces() == 2 + 0 + 3 + 1);
  REQUIRE(mesh.normal.index.size() == mesh.corners.size());
  REQUIRE(mesh.texcoord.index.size() == mesh.corners.size());
  CHECK(!mesh.color.present());
  std::size_t last_face = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    auto was = mesh.normal.index[i] / 100;
    CHECK(mesh.normal.index[i] == 100 * was + mesh.corners[i]);
    CHECK(mesh.texcoord.index[i] == 1000 * was + mesh.corners[i]);
    std::size_t face = std::upper_bound(faces_of.begin(), faces_of.end(), was) - faces_of.begin();
    CHECK(face >= last_face);
    last_face = face;
  }
}

TEST_CASE("quadrilaterals are cut along the better diagonal", "[triangulate]") {
  Job job;
  auto corners = [&](const std::vector<Vec3>& p) {
    faces(job, p, {0, 1, 2, 3, -1});
    job.run();
    return job.mesh.corners;
  };
  const Indices first{0, 1, 2, 0, 2, 3}, second{0, 1, 3, 1, 2, 3};
  CHECK(corners({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == first);
  // concave, at each of the corners
  CHECK(corners({{1, 1, 0}, {3, 0, 0}, {0, 0, 0}, {0, 3, 0}}) == first);
  CHECK(corners({{0, 3, 0}, {1, 1, 0}, {3, 0, 0}, {0, 0, 0}}) == second);
  CHECK(corners({{0, 0, 0}, {0, 3, 0}, {1, 1, 0}, {3, 0, 0}}) == first);
  CHECK(corners({{3, 0, 0}, {0, 0, 0}, {0, 3, 0}, {1, 1, 0}}) == second);
  CHECK(job.diag.count(Diag::concave_face) == 4);
  // a corner on a straight edge
  CHECK(corners({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 5, 0}}) == second);
  CHECK(corners({{1, 5, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}}) == first);
  CHECK(corners({{1e6, 0.1, 0.3}, {1e6, 0.2, 0.3}, {1e6, 0.7, 0.3}, {1e6, 0.4, 0.5}}) == second);
  // warped: the fold is flatter along the shorter diagonal, and the diagonal is 0-2 where they are alike
  CHECK(job.stats.empty());
  CHECK(corners({{-3, 0, 0}, {0, -1, 1}, {3, 0, 0}, {0, 1, 1}}) == second);
  CHECK(corners({{0, -1, 1}, {3, 0, 0}, {0, 1, 1}, {-3, 0, 0}}) == first);
  CHECK(corners({{-1, 0, 0}, {0, -1, 1}, {1, 0, 0}, {0, 1, 1}}) == first);
  CHECK(job.stats["triangulate.non-planar"] == 3);
  CHECK(job.diag.count(Severity::warning) == 4);
}

TEST_CASE("faces without area are dropped and counted", "[triangulate]") {
  Job job;
  SECTION("among polygons") {
    faces(job, square,
          {0, 1, 2, 3, -1, 0, 6, 4, 2, -1, 0, 5, 1, -1, 0, 1, -1, 3, -1, 1, 1, 1, 1, 1, 1, -1, 0, 1, 3, -1, -1});
    CHECK(job.run() == Outcome::changed);
    CHECK(job.mesh.corners == Indices{0, 1, 2, 0, 2, 3, 0, 1, 3});
    REQUIRE(job.diag.count(Diag::degenerate_face) == 1);
    CHECK(job.diag.messages()[0].text() == "IndexedFaceSet: 6 faces without area are dropped");
  }
  SECTION("among triangles") {
    faces(job, square, {0, 1, 2, -1, 0, 5, 1, -1, 2, 2, 3, -1, 0, 2, 3, -1});
    job.mesh.face_begin.clear();
    job.mesh.color.index = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    CHECK(job.run() == Outcome::changed);
    CHECK(job.mesh.corners == Indices{0, 1, 2, 0, 2, 3});
    CHECK(job.mesh.color.index == Indices{0, 1, 2, 9, 10, 11});
    CHECK(job.run() == Outcome::unchanged);
  }
  SECTION("all") {
    faces(job, square, {0, 1, 5, -1});
    CHECK(job.run() == Outcome::changed);
    CHECK(job.mesh.n_faces() == 0);
    CHECK(job.mesh.is_triangles());
  }
  SECTION("thin triangles have an area") {
    faces(job,
          {{0, 0, 0},
           {1, 0, 0},
           {0.5, 1e-9, 0},
           {0.5, 1e-60, 0},
           {1e30, 0, 0},
           {0, 1e30, 0},
           {1e-30, 0, 0},
           {0, 1e-30, 0}},
          {0, 1, 2, -1, 0, 1, 3, -1, 0, 4, 5, -1, 0, 6, 7, -1});
    job.run();
    CHECK(job.mesh.corners == Indices{0, 1, 2, 0, 4, 5, 0, 6, 7});
  }
  SECTION("collinear as printed, but not as rounded to single precision") {
    faces(job, {{0.1, 0.1, 0}, {0.2, 0.3, 0}, {0.4, 0.7, 0}, {0.5, 0.1, 0}, {0.125, 0.1, 0}},
          {0, 1, 2, -1, 0, 3, 4, -1});
    job.run();
    CHECK(job.mesh.corners == Indices{0, 1, 2});
  }
}

TEST_CASE("concave and crossing faces are counted", "[triangulate]") {
  Job job;
  const std::vector<int> arrows{0, 1, 2, 3, 6, -1, 0, 1, 4, 2, 3, -1, 0, 2, 3, 1, -1};
  faces(job, square, arrows);
  job.run();
  REQUIRE(job.diag.messages().size() == 2);
  CHECK(job.diag.messages()[0].text() ==
        "IndexedFaceSet: 2 concave faces although convex is TRUE; they are triangulated correctly");
  CHECK(job.diag.messages()[1].text() ==
        "IndexedFaceSet: 1 face intersects itself; it is triangulated as well as possible");
  faces(job, square, arrows);
  job.mesh.convex = false;
  job.run();
  CHECK(job.diag.count(Diag::concave_face) == 1);
}

TEST_CASE("lines, points and empty meshes stay", "[triangulate]") {
  Job job;
  for (auto kind : {Mesh::Kind::none, Mesh::Kind::lines, Mesh::Kind::points, Mesh::Kind::faces}) {
    job.mesh.clear();
    job.mesh.kind = kind;
    CHECK(job.run() == Outcome::unchanged);
  }
  faces(job, square, {0, 1, 2, 3, -1});
  job.mesh.kind = Mesh::Kind::lines;
  CHECK(job.run() == Outcome::unchanged);
  CHECK(job.mesh.face_begin == Indices{0, 4});
}
