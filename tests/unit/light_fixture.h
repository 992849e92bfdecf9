// Rooms and what light is in them.
#pragma once
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/math/random.h"
#include "light/integrator.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"

namespace wrlkit::light_tests {

using namespace wrlkit::light;

constexpr double pi = 3.14159265358979323846;
using Mode = IntegratorOptions::Mode;

struct Room {
  Diagnostics diag;
  Statistics stats;
  std::unique_ptr<World> parsed;
  std::unique_ptr<LightWorld> world;

  explicit Room(const std::string& body, const LightOptions& options = {}) {
    parsed = parse_world("#VRML V2.0 utf8\n" + body, "test.wrl", {}, diag);
    REQUIRE(parsed);
    std::string why;
    auto pipeline = Pipeline::parse("picture", why);
    PassContext ctx{diag, stats, nullptr};
    auto meshes = pipeline->run_lazily(parsed->scene, ctx);
    world = std::make_unique<LightWorld>(parsed->scene, meshes, nullptr, options, diag);
  }
  std::vector<Irradiance> irradiance(const std::vector<Point>& points, const IntegratorOptions& options) const {
    return Integrator(*world, points, options).irradiance(points);
  }
  Irradiance irradiance(const Point& point, const IntegratorOptions& options) const {
    return irradiance(std::vector<Point>{point}, options)[0];
  }
  /// Mean over places spread evenly over a parallelogram.
  double mean_irradiance(const V3& corner, const V3& a, const V3& b, const V3& normal,
                         const IntegratorOptions& options) const;
};

inline double total(const Irradiance& e) {
  return (e.direct[0] + e.direct[1] + e.direct[2] + e.gathered[0] + e.gathered[1] + e.gathered[2]) / 3;
}
inline double deviation(const Irradiance& e) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += e.direct_variance[k] + e.gathered_variance[k];
  return std::sqrt(sum / 3);
}

inline double Room::mean_irradiance(const V3& corner, const V3& a, const V3& b, const V3& normal,
                                    const IntegratorOptions& options) const {
  std::vector<Point> points;
  Lattice<2> places(7);
  for (std::uint32_t i = 0; i < 1024; ++i) {
    auto [u, v] = places[i];
    points.push_back({corner + u * a + v * b, normal, normal});
  }
  double sum = 0;
  for (const Irradiance& e : irradiance(points, options)) sum += total(e) / static_cast<double>(points.size());
  return sum;
}

// ---- worlds --------------------------------------------------------------------------------------------------------

inline double display(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}
inline std::string grey(double linear) { return fmt::format("{0} {0} {0}", display(linear)); }
inline std::string material(double albedo, double radiance = 0) {
  return fmt::format("appearance Appearance {{ material Material {{ diffuseColor {} emissiveColor {} }} }} ",
                     grey(albedo), grey(radiance));
}
inline const std::string emitting = material(0, 1);

inline std::string at(const V3& p) { return fmt::format("{} {} {} ", p.x, p.y, p.z); }
/// Seen from where the corners run counter-clockwise.
inline std::string quad(const V3& o, const V3& a, const V3& b, const std::string& surface,
                        const std::string& more = "") {
  return "Shape { " + surface + "geometry IndexedFaceSet { " + more +
         " coordIndex [ 0 1 2 3 -1 ] coord Coordinate { point [ " + at(o) + at(o + a) + at(o + a + b) + at(o + b) +
         "] } } }\n";
}
inline std::string polygon(const std::vector<V3>& corners, const std::string& surface) {
  std::string points, index;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points += at(corners[i]);
    index += std::to_string(i) + " ";
  }
  return "Shape { " + surface + "geometry IndexedFaceSet { coordIndex [ " + index + "-1 ] coord Coordinate { point [ " +
         points + "] } } }\n";
}
/// The part of a unit sphere with polar angles between those whose cosines are given, seen from without or within.
inline std::string sphere(const V3& centre, double radius, double from, double to, bool within,
                          const std::string& surface) {
  constexpr int around = 96, rows = 36;
  std::string points, index;
  for (int r = 0; r <= rows; ++r)
    for (int k = 0; k < around; ++k) {
      double polar = std::acos(from) + (std::acos(to) - std::acos(from)) * r / rows, s = std::sin(polar),
             angle = 2 * pi * k / around;
      points += at(centre + radius * V3(s * std::cos(angle), s * std::sin(angle), std::cos(polar)));
    }
  for (int r = 0; r < rows; ++r)
    for (int k = 0; k < around; ++k) {
      int a = r * around + k, b = r * around + (k + 1) % around;
      index += fmt::format("{} {} {} {} -1 ", a, b, b + around, a + around);
    }
  bool ccw = (to > from) != within;
  return fmt::format(
      "Shape {{ {} geometry IndexedFaceSet {{ ccw {} creaseAngle 0 coordIndex [ {} ] coord Coordinate {{ point [ {} ] "
      "}} }} }}\n",
      surface, ccw ? "TRUE" : "FALSE", index, points);
}
/// The inside of the unit cube; the ceiling (z = 1) has a surface of its own.
inline std::string cube(const std::string& walls, const std::string& ceiling) {
  V3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  return quad({}, x, y, walls) + quad(z, y, x, ceiling) + quad({}, z, x, walls) + quad(y, x, z, walls) +
         quad({}, y, z, walls) + quad(x, z, y, walls);
}

inline const Point up{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}};

inline void check(const std::string& name, const Room& room, const Point& p, double expected, int many = 4096) {
  for (Mode mode : {Mode::cached, Mode::path}) {
    INFO(name << (mode == Mode::path ? ", path" : ", cached"));
    Irradiance converged = room.irradiance(p, {.mode = mode, .rays = mode == Mode::path ? 4096 : many});
    // Paths between bright walls have not converged to 0.5 % after any number of rays that a test can afford.
    double allowed = mode == Mode::path ? std::max(0.005 * expected, 3 * deviation(converged)) : 0.005 * expected;
    CHECK(total(converged) == Approx(expected).epsilon(0).margin(allowed));
    Irradiance few = room.irradiance(p, {.mode = mode, .rays = 64});
    CHECK(std::fabs(total(few) - expected) <= 3 * deviation(few) + (mode == Mode::path ? 0.0005 : 0.005) * expected);
  }
}

}  // namespace wrlkit::light_tests
