#include "passes/lower_x3d/earth.h"

#include <cmath>
#include <numbers>

#include "base/math/digits.h"

namespace wrlkit::x3d {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct EllipsoidRow {
  std::string_view code;
  double a, inverse_f;
};

// ISO/IEC 19775-1, table 25.3.
constexpr EllipsoidRow ellipsoids[] = {
    {"AA", 6377563.396, 299.3249646}, {"AM", 6377340.189, 299.3249646},
    {"AN", 6378160, 298.25},          {"BN", 6377483.865, 299.1528128},
    {"BR", 6377397.155, 299.1528128}, {"CC", 6378206.4, 294.9786982},
    {"CD", 6378249.145, 293.465},     {"EA", 6377276.345, 300.8017},
    {"EB", 6377298.556, 300.8017},    {"EC", 6377301.243, 300.8017},
    {"ED", 6377295.664, 300.8017},    {"EE", 6377304.063, 300.8017},
    {"EF", 6377309.613, 300.8017},    {"FA", 6378155, 298.3},
    {"HE", 6378200, 298.3},           {"HO", 6378270, 297},
    {"ID", 6378160, 298.247},         {"IN", 6378388, 297},
    {"KA", 6378245, 298.3},           {"RF", 6378137, 298.257222101},
    {"SA", 6378160, 298.25},          {"WD", 6378135, 298.26},
    {"WE", 6378137, 298.257223563},
};

bool set_zone(std::string_view word, GeoSystem& s) {
  int zone = 0;
  if (word[0] != 'Z' || !read_number(word.substr(1), zone) || zone < 1 || zone > 60) return false;
  s.zone = zone;
  return true;
}

/// False: the keyword is unknown.
bool take(std::string_view word, GeoSystem& s) {
  using Kind = GeoSystem::Kind;
  if (word == "GD" || word == "GDC") {
    s.kind = Kind::geodetic;
    return true;
  }
  if (word == "GC" || word == "GCC") {
    s.kind = Kind::geocentric;
    return true;
  }
  if (word == "UTM") {
    s.kind = Kind::utm;
    return true;
  }
  if (word == "S") return s.south = true;
  if (word == "longitude_first" || word == "easting_first") return s.east_first = true;
  if (word == "latitude_first" || word == "northing_first") return true;
  for (const auto& row : ellipsoids)
    if (row.code == word) {
      s.ellipsoid = {row.a, 1 / row.inverse_f};
      return true;
    }
  return word.size() > 1 && set_zone(word, s);
}

double squared_eccentricity(const Ellipsoid& e) { return e.f * (2 - e.f); }

Vec3 from_geodetic(const Ellipsoid& e, double latitude, double longitude, double height) {
  const double e2 = squared_eccentricity(e), sine = std::sin(latitude), normal = e.a / std::sqrt(1 - e2 * sine * sine);
  const double from_axis = (normal + height) * std::cos(latitude);
  return {from_axis * std::cos(longitude), from_axis * std::sin(longitude), (normal * (1 - e2) + height) * sine};
}

struct Angles {
  double latitude, longitude;
};

/// Krueger's series to the fourth power of n: L. Krueger, Konforme Abbildung des Erdellipsoids in der Ebene, 1912.
Angles from_utm(const GeoSystem& s, double northing, double easting) {
  constexpr double scale = 0.9996, false_easting = 500000, false_northing = 10000000;
  const double n = s.ellipsoid.f / (2 - s.ellipsoid.f), n2 = n * n, n3 = n2 * n, n4 = n2 * n2;
  const double radius = s.ellipsoid.a / (1 + n) * (1 + n2 / 4 + n4 / 64);
  const double beta[] = {n / 2 - 2 * n2 / 3 + 37 * n3 / 96 - n4 / 360, n2 / 48 + n3 / 15 - 437 * n4 / 1440,
                         17 * n3 / 480 - 37 * n4 / 840, 4397 * n4 / 161280};
  const double xi = (northing - (s.south ? false_northing : 0)) / (scale * radius),
               eta = (easting - false_easting) / (scale * radius);
  double x = xi, y = eta;
  for (int j = 1; j <= 4; ++j) {
    x -= beta[j - 1] * std::sin(2 * j * xi) * std::cosh(2 * j * eta);
    y -= beta[j - 1] * std::cos(2 * j * xi) * std::sinh(2 * j * eta);
  }
  // From the conformal latitude to the geodetic one, by a fixed point that takes a digit and more a step.
  const double conformal = std::asinh(std::sin(x) / std::hypot(std::sinh(y), std::cos(x))),
               eccentricity = std::sqrt(squared_eccentricity(s.ellipsoid));
  double latitude = std::atan(std::sinh(conformal));
  for (int i = 0; i < 12; ++i)
    latitude = std::atan(std::sinh(conformal + eccentricity * std::atanh(eccentricity * std::sin(latitude))));
  return {latitude, (6 * s.zone - 183) * degree + std::atan2(std::sinh(y), std::cos(x))};
}

}  // namespace

GeoSystem geo_system(std::span<const std::string_view> words, std::vector<std::string>& unknown) {
  GeoSystem s;
  for (std::string_view word : words)
    if (!take(word, s)) unknown.emplace_back(word);
  return s;
}

Vec3 geocentric(const GeoSystem& s, const Vec3& place) {
  if (s.kind == GeoSystem::Kind::geocentric) return place;
  const double north = place[s.east_first ? 1 : 0], east = place[s.east_first ? 0 : 1];
  if (s.kind == GeoSystem::Kind::geodetic) return from_geodetic(s.ellipsoid, north * degree, east * degree, place[2]);
  const auto [latitude, longitude] = from_utm(s, north, east);
  return from_geodetic(s.ellipsoid, latitude, longitude, place[2]);
}

Vec3 geodetic(const Ellipsoid& e, const Vec3& p) {
  const double from_axis = std::hypot(p[0], p[1]), e2 = squared_eccentricity(e), b = e.a * (1 - e.f);
  // Bowring's formula, applied again to what it gives.
  double reduced = std::atan2(p[2] * e.a, from_axis * b), latitude = 0;
  for (int i = 0; i < 5; ++i) {
    const double s = std::sin(reduced), c = std::cos(reduced);
    latitude = std::atan2(p[2] + e2 / (1 - e2) * b * s * s * s, from_axis - e2 * e.a * c * c * c);
    reduced = std::atan2((1 - e.f) * std::sin(latitude), std::cos(latitude));
  }
  const double s = std::sin(latitude), c = std::cos(latitude);
  const double height = from_axis * c + p[2] * s - e.a * std::sqrt(1 - e2 * s * s);
  return {latitude / degree, std::atan2(p[1], p[0]) / degree, height};
}

Matrix standing_at(const Vec3& geodetic) {
  const double sl = std::sin(geodetic[0] * degree), cl = std::cos(geodetic[0] * degree),
               so = std::sin(geodetic[1] * degree), co = std::cos(geodetic[1] * degree);
  return matrix_of_columns({-so, co, 0}, {cl * co, cl * so, sl}, {sl * co, sl * so, -cl});
}

}  // namespace wrlkit::x3d
