#include "geometry/half_space.h"

#include <catch2/catch.hpp>

using namespace wrlkit;

namespace {

/// A square of two triangles from (-1, -1) to (1, 1), with a texture coordinate at each corner.
Mesh square_mesh() {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  m.positions.edit() = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
  m.corners = {0, 1, 2, 0, 2, 3};
  m.texcoord.values = {0, 0, 1, 0, 1, 1, 0, 1};
  m.texcoord.index = m.corners;
  return m;
}

double area_of(const Mesh& m) {
  double sum = 0;
  for (std::size_t i = 0; i < m.corners.size(); i += 3)
    sum += length(cross(m.position(m.corners[i + 1]) - m.position(m.corners[i]),
                        m.position(m.corners[i + 2]) - m.position(m.corners[i]))) /
           2;
  return sum;
}

}  // namespace

TEST_CASE("A plane cuts triangles, and what their corners have", "[geometry]") {
  Mesh m = square_mesh();
  CHECK(cut_by_plane(m, {1, 0, 0, 0.5}));
  CHECK(area_of(m) == Approx(3));
  CHECK(m.n_positions() == 5);  // two of the square, three on the plane, each once
  CHECK(m.texcoord.index.size() == m.corners.size());
  for (std::size_t i = 0; i < m.corners.size(); ++i)
    CHECK(m.texcoord.at(m.texcoord.index[i])[0] == Approx((m.position(m.corners[i])[0] + 1) / 2));
}

TEST_CASE("A plane next to a mesh, behind it, and through its corners", "[geometry]") {
  Mesh m = square_mesh();
  CHECK_FALSE(cut_by_plane(m, {1, 0, 0, 1}));
  CHECK(m.corners.size() == 6);
  CHECK(cut_by_plane(m, {-1, 1, 0, 0}));
  CHECK(m.corners.size() == 3);
  CHECK(area_of(m) == Approx(2));
  CHECK(cut_by_plane(m, {0, 0, 1, -1}));
  CHECK(m.corners.empty());
}

TEST_CASE("A plane cuts lines and points", "[geometry]") {
  Mesh m;
  m.kind = Mesh::Kind::lines;
  m.positions.edit() = {0, 0, 0, 1, 0, 0, 3, 0, 0};
  m.corners = {0, 1, 2};
  m.face_begin = {0, 3};
  CHECK(cut_by_plane(m, {-1, 0, 0, 2}));
  REQUIRE(m.n_faces() == 2);
  CHECK(m.position(m.corners[3])[0] == Approx(2));
  m.kind = Mesh::Kind::points;
  m.face_begin.clear();
  CHECK(cut_by_plane(m, {-1, 0, 0, 0.5}));
  CHECK(m.corners.size() == 1);
}

TEST_CASE("A plane below a matrix", "[geometry]") {
  Matrix m = translation_matrix({1, 2, 3});
  m(0, 0) = 2;
  const Vec4 plane{1, 1, 0, -4}, below = plane_below(plane, m);
  const Vec3 p{5, 6, 7}, at = m.point(p);
  CHECK(below[0] * p[0] + below[1] * p[1] + below[2] * p[2] + below[3] == Approx(at[0] + at[1] - 4));
}
