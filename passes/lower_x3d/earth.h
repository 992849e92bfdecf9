// Places on Earth in metres: what the numbers of a geoSystem mean (ISO/IEC 19775-1, 25.2). Everything is in double
// precision.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/transform.h"

namespace wrlkit::x3d {

struct Ellipsoid {
  double a = 6378137, f = 1 / 298.257223563;  // of WGS84: the equator's radius in metres, and the flattening
};

/// What the numbers of a place mean.
struct GeoSystem {
  enum class Kind { geodetic, utm, geocentric };
  Kind kind = Kind::geodetic;
  Ellipsoid ellipsoid;
  int zone = 1;             // of UTM
  bool south = false;       // UTM of the southern hemisphere
  bool east_first = false;  // longitude or easting stands first
};

/// From the keywords of a geoSystem field. Unknown ones are left out, and the default taken; `unknown` gets those.
GeoSystem geo_system(std::span<const std::string_view> words, std::vector<std::string>& unknown);

/// Geocentric metres: X through Greenwich on the equator, Z through the north pole. Of degrees and metres (latitude,
/// longitude, height), of metres in a zone of UTM (northing, easting, height; by Krueger's series, to a micrometre
/// within 3000 km of its meridian), or of what is geocentric already.
Vec3 geocentric(const GeoSystem&, const Vec3& place);

/// Latitude and longitude in degrees, and height above the ellipsoid, to a micrometre for heights from -5000 km to
/// beyond the Moon.
Vec3 geodetic(const Ellipsoid&, const Vec3& geocentric);

/// Columns east, up and south: the axes of a person standing there, X to the right when looking north. O(1).
Matrix standing_at(const Vec3& geodetic);

}  // namespace wrlkit::x3d
