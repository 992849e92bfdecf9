// The planes along the spine of an Extrusion (ISO/IEC 14772-1, 6.18.3).
#include <catch2/catch.hpp>
#include <random>

#include "geometry/shapes/spine.h"
#include "tests/unit/geometry_fixture.h"

using namespace wrlkit;
using namespace wrlkit::geometry_tests;

namespace {

using Points = std::vector<Vec3>;
bool close(const Vec3& a, const Vec3& b) { return length(a - b) < 1e-9; }

}  // namespace

TEST_CASE("Spine: straight ones turn Y into their direction", "[geometry]") {
  auto up = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {0, 3, 0}});
  for (auto& p : up) CHECK((close(p.x, {1, 0, 0}) && close(p.y, {0, 1, 0}) && close(p.z, {0, 0, 1})));
  auto right = spine_planes(Points{{0, 0, 0}, {1, 0, 0}});
  CHECK((close(right[1].x, {0, -1, 0}) && close(right[1].y, {1, 0, 0}) && close(right[1].z, {0, 0, 1})));
  auto down = spine_planes(Points{{0, 0, 0}, {0, -1, 0}});
  CHECK((close(down[0].x, {-1, 0, 0}) && close(down[0].y, {0, -1, 0}) && close(down[0].z, {0, 0, 1})));
  auto front = spine_planes(Points{{0, 0, 0}, {0, 0, 2}, {0, 0, 2}});
  CHECK((close(front[2].x, {1, 0, 0}) && close(front[2].y, {0, 0, 1}) && close(front[2].z, {0, -1, 0})));
}

TEST_CASE("Spine: six printed digits of a slanted line are straight", "[geometry]") {
  auto planes = spine_planes(Points{
      {0.123457, 0.234568, 0.345679}, {1.12346, 1.23457, 1.34568}, {2.12346, 2.23457, 2.34568}, {5, 5.11111, 5.22222}});
  for (auto& p : planes) CHECK(length(p.x - planes[0].x) < 1e-4);
  CHECK(dot(planes[0].y, Vec3{1, 1, 1}) == Approx(std::sqrt(3)));
}

TEST_CASE("Spine: bends, straight parts and flips", "[geometry]") {
  // up, to the right, up again: the second bend turns the other way, its Z axis is flipped (g)
  auto p = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}});
  for (auto& plane : p) CHECK(close(plane.z, {0, 0, -1}));
  CHECK(close(p[0].y, {0, 1, 0}));
  CHECK(close(p[0].x, {-1, 0, 0}));
  CHECK(close(p[1].y, {std::sqrt(0.5), std::sqrt(0.5), 0}));
  CHECK(close(p[2].y, {1, 0, 0}));  // collinear: the Z axis of the point before
  CHECK(close(p[4].y, {0, 1, 0}));
}

TEST_CASE("Spine: leading straight parts take the first Z axis there is", "[geometry]") {
  auto p = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 1}});
  for (auto& plane : p) CHECK(close(plane.z, {1, 0, 0}));
}

TEST_CASE("Spine: coincident points have one plane", "[geometry]") {
  auto p = spine_planes(Points{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 1, 0}});
  CHECK(close(p[1].y, {std::sqrt(0.5), std::sqrt(0.5), 0}));
  CHECK(close(p[1].y, p[2].y));
  CHECK(close(p[1].x, p[2].x));
  auto still = spine_planes(Points(3, Vec3{7, 8, 9}));
  CHECK(still.size() == 3);
  CHECK((close(still[2].x, {1, 0, 0}) && close(still[2].y, {0, 1, 0})));
  CHECK(spine_planes({}).empty());
}

TEST_CASE("Spine: closed ones have the same plane at both ends", "[geometry]") {
  auto p = spine_planes(Points{{1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}, {1, 0, 0}});
  CHECK(close(p[0].y, {0, 0, 1}));  // from the point before the seam to the one behind it
  CHECK(close(p[0].z, p[4].z));
  CHECK(std::abs(p[0].z[1]) == Approx(1));
  CHECK(close(p[0].x, p[4].x));
  for (auto& plane : p) CHECK(close(plane.x, cross(plane.y, plane.z)));
}

TEST_CASE("Spine: hairpins and noise stay orthonormal", "[geometry]") {
  auto points = GENERATE(Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, Points{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}},
                         Points{{0, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 5, 0}, {1e-20, 0, 0}},
                         Points{{1e6, 0, 0}, {1e6, 1, 0}, {1e6, 2, 1e-9}, {1e6, 3, 0}, {1e6, 3, 1e-9}});
  for (auto& plane : spine_planes(points)) {
    CHECK(length(plane.x) == Approx(1));
    CHECK(length(plane.y) == Approx(1));
    CHECK(close(plane.z, cross(plane.x, plane.y)));
    CHECK(dot(plane.x, plane.y) == Approx(0).margin(1e-9));
  }
}
