// Lamps that fall by the square of the distance, against closed formulas.
#include "tests/unit/light_fixture.h"

using namespace wrlkit;
using namespace wrlkit::light_tests;
using namespace wrlkit::light;

namespace {

/// A black sphere around the origin, seen from within.
std::string around(double radius) { return sphere({}, radius, -1, 1, true, material(0)); }

/// Irradiance where the light of a lamp at the origin falls perpendicularly, in parts of a lamp as strong as it may be.
double at_distance(const std::string& lamp, const std::string& things, double distance,
                   LampFall fall = LampFall::inverse_square) {
  Room room(lamp + " " + things, {.lamps = fall, .sky = LightOptions::Sky::none});
  const V3 towards(-1, 0, 0);
  return total(room.irradiance(Point{{distance, 0, 0}, towards, towards}, {.rays = 1})) / pi;
}

constexpr double facets = 0.01;  // a sphere of facets is nearer than a sphere

}  // namespace

TEST_CASE("lamps: by the square of the distance, as strong as written at what they shine at", "[light]") {
  const std::string lamp = "PointLight { }";
  CHECK(at_distance(lamp, around(3), 1, LampFall::as_written) == Approx(1));
  CHECK(at_distance(lamp, around(3), 1) == Approx(9).epsilon(facets));
  CHECK(at_distance(lamp, around(3), 2) == Approx(9. / 4).epsilon(facets));
  // Linear attenuation: 1 / 3 there.
  CHECK(at_distance("PointLight { attenuation 0 1 0 }", around(3), 1) == Approx(3).epsilon(facets));
}

TEST_CASE("lamps: light goes on beyond the radius, where the lamp is as strong as written", "[light]") {
  const std::string lamp = "PointLight { radius 1 }";
  CHECK(at_distance(lamp, around(4), 2, LampFall::as_written) == 0);
  CHECK(at_distance(lamp, around(4), 2) == Approx(0.25));
  CHECK(at_distance(lamp, around(4), 1) == Approx(1));
}

TEST_CASE("lamps: one that fell by the square as written stays as it is, but for the cut at 1", "[light]") {
  const std::string lamp = "PointLight { attenuation 0 0 1 }";
  for (const double d : {1.0, 2.0, 3.0}) {
    CHECK(at_distance(lamp, around(4), d) == Approx(1 / (d * d)));
    CHECK(at_distance(lamp, around(4), d, LampFall::as_written) == Approx(1 / (d * d)));
  }
  CHECK(at_distance(lamp, around(4), 0.5) == Approx(4));
  CHECK(at_distance(lamp, around(4), 0.5, LampFall::as_written) == Approx(1));
}

TEST_CASE("lamps: nearer than a tenth of the distance nothing becomes brighter", "[light]") {
  CHECK(at_distance("PointLight { }", around(3), 0.3) == Approx(100).epsilon(facets));
  CHECK(at_distance("PointLight { }", around(3), 0.01) == Approx(100).epsilon(facets));
}

TEST_CASE("lamps: distances are those of the frame", "[light]") {
  const std::string lamp = "Transform { scale 2 2 2 children PointLight { radius 0.5 } }";
  CHECK(at_distance(lamp, around(4), 2) == Approx(0.25));
}

TEST_CASE("lamps: glass is no surface that they shine at, nor is what a spot does not reach", "[light]") {
  const std::string glass =
      "Shape { appearance Appearance { material Material { transparency 1 } } geometry Sphere { "
      "radius 0.1 } } ";
  CHECK(at_distance("PointLight { }", glass + around(2), 1) == Approx(4).epsilon(facets));
  // Of two plates it shines at the one.
  const std::string near = quad({-0.5, -9, -9}, {0, 0, 18}, {0, 18, 0}, material(0), "solid FALSE"),
                    far = quad({2, -9, -9}, {0, 0, 18}, {0, 18, 0}, material(0), "solid FALSE");
  const std::string spot = "SpotLight { direction 1 0 0 beamWidth 0.02 cutOffAngle 0.02 }";
  CHECK(at_distance(spot, near + far, 1) == Approx(4).epsilon(facets));
}

TEST_CASE("lamps: what shines at nothing stays as it was written", "[light]") {
  CHECK(at_distance("PointLight { radius 5 }", "", 4) == Approx(1));
  CHECK(at_distance("PointLight { radius 5 }", "", 6) == 0);
}

TEST_CASE("lamps: as much light as written reaches a room within the radius", "[light]") {
  // The flux onto a closed room is the integral over directions of strength times distance squared.
  const std::string room =
      "Shape { " + material(0) + "geometry Box { size 3 4 5 } }" + " PointLight { location 0.3 0.5 -0.7 }";
  Room written(room), spread(room, {.lamps = LampFall::inverse_square});
  const auto& light = spread.world->lamps()[0].light;
  REQUIRE(light.fall);
  CHECK(light.fall->strength == 1);
  double sum = 0;
  Lattice<2> lattice(3);
  constexpr int n = 4096;
  for (int i = 0; i < n; ++i) {
    const auto [u, v] = lattice[static_cast<std::uint32_t>(i)];
    const double z = 1 - 2 * u, r = std::sqrt(1 - z * z);
    const V3 way(r * std::cos(2 * pi * v), r * std::sin(2 * pi * v), z);
    Hit hit;
    REQUIRE(written.world->nearest({light.location, way}, 0, hit));
    sum += hit.distance * hit.distance / n;
  }
  CHECK(light.fall->distance * light.fall->distance == Approx(sum).epsilon(0.02));
}
