// Normals of levels: those of the part, unless a face would be dark with them.
#include <catch2/catch.hpp>

#include <cmath>

#include "geometry/normals.h"
#include "geometry/simplify/given_attributes.h"
#include "geometry/simplify/surfaces.h"
#include "test_world.h"

using namespace wrlkit;
using namespace wrlkit::simplify;

namespace {

/// A wall of a prism around a pipe of radius 1, whose corners lie at these angles to either side of its middle.
Mesh wall(double degrees) {
  const double angle = degrees * 3.14159265358979 / 180, x = std::cos(angle), z = std::sin(angle);
  Mesh mesh;
  mesh.kind = Mesh::Kind::faces;
  mesh.positions.edit() = {x, -9, -z, x, -9, z, x, 9, z, x, 9, -z};
  mesh.corners = {0, 2, 1, 0, 3, 2};
  return mesh;
}

/// The largest angle between a normal of the wall and its face, in degrees, when a pipe has given it its normals.
double turned(double degrees) {
  TestWorld w("Shape { geometry Cylinder { height 20 } }");
  Mesh pipe;
  SurfaceReader(w.scene, w.ctx).read(surfaces_of(w.scene)[0], pipe);
  MeshScratch scratch;
  make_normals(pipe, scratch, pipe.crease_angle);
  Mesh mesh = wall(degrees);
  GivenAttributes(pipe).give(mesh);
  REQUIRE(mesh.normal.present());
  double least = 1;
  for (const auto i : mesh.normal.index) least = std::min(least, static_cast<double>(mesh.normal.at(i)[0]));
  return std::acos(least) * 180 / 3.14159265358979;
}

}  // namespace

TEST_CASE("given attributes: a pipe of three sides is round, and no face that is seen is dark", "[levels]") {
  CHECK(turned(45) == Approx(45).margin(6));
  CHECK(turned(58) == Approx(58).margin(6));
  CHECK(turned(75) < 1);
}
