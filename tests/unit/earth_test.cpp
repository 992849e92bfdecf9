// Places on Earth against figures that others have published, and against what has to be so.
#include <catch2/catch.hpp>
#include <cmath>

#include "passes/lower_x3d/earth.h"

using namespace wrlkit;
using namespace wrlkit::x3d;

namespace {

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

GeoSystem system_of(std::initializer_list<std::string_view> words) {
  std::vector<std::string> unknown;
  auto s = geo_system(std::vector<std::string_view>(words), unknown);
  CHECK(unknown.empty());
  return s;
}

}  // namespace

TEST_CASE("earth: the axes of the ellipsoid", "[earth]") {
  CHECK(distance(geocentric({}, {0, 0, 0}), {6378137, 0, 0}) < 1e-9);
  CHECK(distance(geocentric({}, {0, 90, 10}), {0, 6378147, 0}) < 1e-9);
  CHECK(distance(geocentric({}, {90, 0, 0}), {0, 0, 6356752.314245179}) < 1e-8);  // b of WGS84
  CHECK(distance(geocentric(system_of({"GD", "WE", "longitude_first"}), {90, 0, 0}), {0, 6378137, 0}) < 1e-9);
  CHECK(distance(geocentric(system_of({"GC"}), {1, 2, 3}), {1, 2, 3}) == 0);
  CHECK(distance(geocentric(system_of({"GD", "CC"}), {0, 0, 0}), {6378206.4, 0, 0}) < 1e-9);  // Clarke 1866
}

TEST_CASE("earth: there and back, from the poles to the date line", "[earth]") {
  for (double latitude = -90; latitude <= 90; latitude += 7.5)
    for (double longitude = -180; longitude < 180; longitude += 30)
      for (double height : {-5e6, -1e4, 0.0, 9e3, 4e8}) {
        const Vec3 p = geocentric({}, {latitude, longitude, height});
        CHECK(distance(geocentric({}, geodetic({}, p)), p) < 1e-6);
      }
}

// What the README of the Python package utm says, and the CN Tower by the article Universal Transverse Mercator of
// Wikipedia.
TEST_CASE("earth: UTM", "[earth]") {
  const auto degrees = [](std::initializer_list<std::string_view> words, const Vec3& place) {
    const auto s = system_of(words);
    return geodetic(s.ellipsoid, geocentric(s, place));
  };
  const Vec3 ruhr = degrees({"UTM", "Z32"}, {5710000, 340000, 12});
  CHECK(ruhr[0] == Approx(51.51852098408468).margin(1e-8));
  CHECK(ruhr[1] == Approx(6.693872395145327).margin(1e-8));
  CHECK(ruhr[2] == Approx(12).margin(1e-6));
  const Vec3 other = degrees({"UTM", "Z32", "easting_first"}, {395201.3103811303, 5673135.241182375, 0});
  CHECK(other[0] == Approx(51.2).margin(1e-8));
  CHECK(other[1] == Approx(7.5).margin(1e-8));
  const Vec3 tower = degrees({"UTM", "Z17"}, {4833438, 630084, 0});
  CHECK(tower[0] == Approx(43 + 38 / 60.0 + 33.24 / 3600).margin(1e-5));
  CHECK(tower[1] == Approx(-(79 + 23 / 60.0 + 13.7 / 3600)).margin(1e-5));
  // On its meridian, and as far south as north.
  CHECK(degrees({"UTM", "Z31"}, {0, 500000, 0})[1] == Approx(3).margin(1e-12));
  CHECK(degrees({"UTM", "Z31", "S"}, {10000000 - 4000000, 400000, 0})[0] ==
        Approx(-degrees({"UTM", "Z31"}, {4000000, 400000, 0})[0]).margin(1e-12));
  // Along the meridian the scale is 0.9996: the length of a quarter of it is 10001965.729 m.
  CHECK(degrees({"UTM", "Z31"}, {0.9996 * 10001965.729, 500000, 0})[0] == Approx(90).margin(1e-8));
}

TEST_CASE("earth: who stands there has east to the right, and up above", "[earth]") {
  const Matrix greenwich = standing_at({0, 0, 0});
  CHECK(distance(greenwich.point({1, 0, 0}), {0, 1, 0}) < 1e-15);
  CHECK(distance(greenwich.point({0, 1, 0}), {1, 0, 0}) < 1e-15);
  CHECK(distance(greenwich.point({0, 0, -1}), {0, 0, 1}) < 1e-15);
  CHECK(standing_at({51, 7, 0}).determinant() == Approx(1).margin(1e-15));
  const Vec3 here = geocentric({}, {51, 7, 100}), above = geocentric({}, {51, 7, 101}),
             up = standing_at({51, 7, 0}).point({0, 1, 0});
  CHECK(distance(above, {here[0] + up[0], here[1] + up[1], here[2] + up[2]}) < 1e-8);
}

TEST_CASE("earth: words that nobody knows", "[earth]") {
  std::vector<std::string> unknown;
  const std::vector<std::string_view> words{"UTM", "Z61", "WGS84", "XX", "Z33"};
  CHECK(geo_system(words, unknown).zone == 33);
  CHECK(unknown == std::vector<std::string>{"Z61", "WGS84", "XX"});
}
