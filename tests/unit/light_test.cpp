// Light against closed formulas: form factors, furnaces, lamps, skies with walls; by the cached integrator and by path
// tracing. Seeds are fixed. Each value is checked twice: within 0.5 % with many rays, and within three standard errors
// with few. Of seeds 99.7 % would pass the second if errors were normal and the variance exact; it is an upper bound,
// so more do. It does not know the error of the cache, for which 0.5 % is allowed beside.
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <catch2/catch.hpp>
#include <cmath>

#include "light/integrator.h"
#include "light/random.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"

using namespace wrlkit;
using namespace wrlkit::light;

namespace {

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

double total(const Irradiance& e) {
  return (e.direct[0] + e.direct[1] + e.direct[2] + e.gathered[0] + e.gathered[1] + e.gathered[2]) / 3;
}
double deviation(const Irradiance& e) {
  double sum = 0;
  for (int k = 0; k < 3; ++k) sum += e.direct_variance[k] + e.gathered_variance[k];
  return std::sqrt(sum / 3);
}

double Room::mean_irradiance(const V3& corner, const V3& a, const V3& b, const V3& normal,
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

double display(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}
std::string grey(double linear) { return fmt::format("{0} {0} {0}", display(linear)); }
std::string material(double albedo, double radiance = 0) {
  return fmt::format("appearance Appearance {{ material Material {{ diffuseColor {} emissiveColor {} }} }} ",
                     grey(albedo), grey(radiance));
}
const std::string emitting = material(0, 1);

std::string at(const V3& p) { return fmt::format("{} {} {} ", p.x, p.y, p.z); }
/// Seen from where the corners run counter-clockwise.
std::string quad(const V3& o, const V3& a, const V3& b, const std::string& surface, const std::string& more = "") {
  return "Shape { " + surface + "geometry IndexedFaceSet { " + more +
         " coordIndex [ 0 1 2 3 -1 ] coord Coordinate { point [ " + at(o) + at(o + a) + at(o + a + b) + at(o + b) +
         "] } } }\n";
}
std::string polygon(const std::vector<V3>& corners, const std::string& surface) {
  std::string points, index;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points += at(corners[i]);
    index += std::to_string(i) + " ";
  }
  return "Shape { " + surface + "geometry IndexedFaceSet { coordIndex [ " + index + "-1 ] coord Coordinate { point [ " +
         points + "] } } }\n";
}
/// The part of a unit sphere with polar angles between those whose cosines are given, seen from without or within.
std::string sphere(const V3& centre, double radius, double from, double to, bool within, const std::string& surface) {
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
std::string cube(const std::string& walls, const std::string& ceiling) {
  V3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  return quad({}, x, y, walls) + quad(z, y, x, ceiling) + quad({}, z, x, walls) + quad(y, x, z, walls) +
         quad({}, y, z, walls) + quad(x, z, y, walls);
}

const Point up{{0, 0, 0}, {0, 0, 1}, {0, 0, 1}};

void check(const std::string& name, const Room& room, const Point& p, double expected, int many = 4096) {
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

}  // namespace

TEST_CASE("light: a square emitter over a point") {
  // 4 pi times the form factor of a quarter; off the axis Lambert's sum over the polygon's edges.
  struct {
    double height, x, y, expected;
  } cases[] = {{0.5, 0, 0, 1.74083950}, {1, 0, 0, 0.75227469}, {2, 0, 0, 0.23083680},    {5, 0, 0, 0.03947403},
               {1, 1, 0, 0.26500485},   {1, 2, 1, 0.03023652}, {1, 0.5, 0.5, 0.43520988}};
  for (auto& c : cases) {
    Room room(quad({-0.5, -0.5, c.height}, {0, 1, 0}, {1, 0, 0}, emitting));
    check(fmt::format("height {} at {} {}", c.height, c.x, c.y), room, {{c.x, c.y, 0}, {0, 0, 1}, {0, 0, 1}},
          c.expected);
  }
}

TEST_CASE("light: an emitter at right angles") {
  Room high(quad({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, emitting)), near(quad({0.5, 0, 0}, {0, 0, 2}, {0, 1, 0}, emitting));
  check("height 1, distance 1", high, up, 0.17509414);
  check("height 2, distance 0.5", near, up, 0.49880576);
}

TEST_CASE("light: a sphere that emits") {
  struct {
    double radius, distance, angle, expected;
  } cases[] = {{1, 2, 0, 0.78539816},
               {0.5, 3, 0, 0.08726646},
               {1, 3, 30, 0.30229989},
               {1, 3, 60, 0.17453293},
               {1, 3, 70, 0.11938755}};
  for (auto& c : cases) {
    double a = c.angle * pi / 180;
    Room room(sphere({c.distance * std::sin(a), 0, c.distance * std::cos(a)}, c.radius, -1, 1, false, emitting));
    check(fmt::format("radius {} distance {} angle {}", c.radius, c.distance, c.angle), room, up, c.expected);
  }
}

TEST_CASE("light: a disk that emits") {
  for (auto [radius, height, expected] : {std::array{1.0, 1.0, 1.57079633}, std::array{0.5, 2.0, 0.18479957}}) {
    std::vector<V3> rim;
    for (int i = 0; i < 256; ++i)
      rim.push_back({radius * std::sin(2 * pi * i / 256), radius * std::cos(2 * pi * i / 256), height});
    check(fmt::format("radius {}", radius), Room(polygon(rim, emitting)), up, expected);
  }
}

TEST_CASE("light: a PointLight over a plane") {
  // I h / (h^2 + r^2)^1.5 with I = pi: intensity 1, attenuation by the square of the distance.
  for (auto [height, offset, per_intensity] :
       {std::array{2.0, 0.0, 0.25}, std::array{2.0, 1.5, 0.128}, std::array{3.0, 4.0, 0.024}}) {
    Room room(fmt::format("PointLight {{ location {} 0 {} attenuation 0 0 1 }}", offset, height));
    Irradiance e = room.irradiance(up, {.rays = 1});
    CHECK(total(e) == Approx(pi * per_intensity));
    CHECK(deviation(e) == 0);
  }
}

TEST_CASE("light: a sky with walls") {
  LightOptions white{.sky = LightOptions::Sky::constant};
  check("open plane", Room("", white), up, pi);
  for (auto [degrees, expected] :
       {std::array{30.0, 2.93114585}, std::array{45.0, 2.68151706}, std::array{60.0, 2.35619449}}) {
    // A wall that is large and far enough to count as infinite.
    Room room(quad({1, -5e3, 0}, {0, 0, std::tan(degrees * pi / 180)}, {0, 1e4, 0}, material(0)), white);
    check(fmt::format("wall of {} degrees", degrees), room, up, expected);
  }
  std::string tall = quad({1e-3, -5e3, 0}, {0, 0, 1e4}, {0, 1e4, 0}, material(0)),
              other = quad({5e3, 1e-3, 0}, {0, 0, 1e4}, {-1e4, 0, 0}, material(0));
  check("foot of a tall wall", Room(tall, white), up, pi / 2);
  check("corner of two", Room(tall + other, white), up, pi / 4);
}

TEST_CASE("light: white furnace") {
  // Closed, all surfaces emit 1: irradiance pi / (1 - albedo) everywhere.
  for (double albedo : {0.2, 0.5, 0.8, 0.9, 0.95}) {
    Room room(cube(material(albedo, 1), material(albedo, 1)));
    check(fmt::format("albedo {}", albedo), room, {{0.3, 0.4, 0}, {0, 0, 1}, {0, 0, 1}}, pi / (1 - albedo), 1 << 14);
  }
}

TEST_CASE("light: the inside of a sphere") {
  // A part f of it emits: every point gets f M / (1 - sum of f_i albedo_i), M = pi.
  struct {
    double f, albedo, other, expected;
  } cases[] = {{0.1, 0.5, 0.5, 0.2},
               {0.05, 0.8, 0.8, 0.25},
               {0.5, 0.8, 0.8, 2.5},
               {0.25, 0.5, 0.8, 0.90909091},
               {0.25, 0.3, 0.9, 1}};
  for (auto& c : cases) {
    double edge = 1 - 2 * c.f;
    Room room(sphere({}, 1, 1, edge, true, material(c.albedo, 1)) + sphere({}, 1, edge, -1, true, material(c.other)));
    check(fmt::format("f {} albedo {} and {}", c.f, c.albedo, c.other), room, {{0, 0, -0.999}, {0, 0, 1}, {0, 0, 1}},
          pi * c.expected, 1 << 14);
  }
}

TEST_CASE("light: a cube with a ceiling that emits") {
  // Continuous radiosity, means over faces; by collocation on 24 x 24 patches a face, in units of the exitance.
  struct {
    double albedo, floor, wall, ceiling;
  } cases[] = {{0, 0.19982, 0.20004, 0}, {0.5, 0.34256, 0.36226, 0.20840}, {0.8, 0.82649, 0.85994, 0.73376}};
  for (auto& c : cases) {
    Room room(cube(material(c.albedo), material(c.albedo, 1)));
    for (Mode mode : {Mode::cached, Mode::path}) {
      INFO("albedo " << c.albedo << (mode == Mode::path ? ", path" : ", cached"));
      IntegratorOptions o{.mode = mode, .rays = 64};
      CHECK(room.mean_irradiance({}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, o) / pi == Approx(c.floor).epsilon(0.005));
      CHECK(room.mean_irradiance({}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, o) / pi == Approx(c.wall).epsilon(0.005));
      CHECK(room.mean_irradiance({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}, o) / pi ==
            Approx(c.ceiling).epsilon(0.005).margin(1e-9));
    }
  }
}

TEST_CASE("light: rectangles that face each other, or share an edge") {
  struct {
    double distance, factor;
  } parallel[] = {{1, 0.19982490}, {0.5, 0.41525328}, {2, 0.06858959}};
  for (auto& c : parallel) {
    Room room(quad({0, 0, c.distance}, {0, 1, 0}, {1, 0, 0}, emitting));
    for (Mode mode : {Mode::cached, Mode::path})
      CHECK(room.mean_irradiance({}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.mode = mode, .rays = 16}) / pi ==
            Approx(c.factor).epsilon(0.005));
  }
  // From an upright emitter of height h to a floor of depth w: F(floor, wall).
  struct {
    double w, h, factor;
  } edge[] = {{1, 1, 0.20004378}, {2, 1, 0.11642630}, {1, 2, 0.23285260}, {1, 0.5, 0.14618668}};
  for (auto& c : edge) {
    Room room(quad({}, {0, 1, 0}, {0, 0, c.h}, emitting));
    for (Mode mode : {Mode::cached, Mode::path})
      CHECK(room.mean_irradiance({}, {c.w, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.mode = mode, .rays = 64}) / pi ==
            Approx(c.factor).epsilon(0.005));
  }
}

TEST_CASE("light: two squares between which light goes to and fro") {
  // Distance 1, lower one emits; in units of its exitance, continuous.
  struct {
    double albedo, lower, upper;
  } cases[] = {{0.5, 0.020436, 0.201894}, {0.8, 0.033235, 0.205210}};
  for (auto& c : cases) {
    Room room(quad({}, {1, 0, 0}, {0, 1, 0}, material(c.albedo, 1)) +
              quad({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, material(c.albedo)));
    for (Mode mode : {Mode::cached, Mode::path}) {
      IntegratorOptions o{.mode = mode, .rays = 256};
      CHECK(room.mean_irradiance({}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, o) / pi == Approx(c.lower).epsilon(0.005));
      CHECK(room.mean_irradiance({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, o) / pi ==
            Approx(c.upper).epsilon(0.005));
    }
  }
}

// ---- VRML's lights -------------------------------------------------------------------------------------------------

TEST_CASE("light: as bright as the browser shows it") {
  // Intensity 1, white, perpendicular: a white surface reflects radiance 1.
  Room sun("DirectionalLight { direction 0 0 -1 } " + quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, material(0.5)));
  Point p = up;
  p.use = 0;
  CHECK(total(sun.irradiance(p, {.rays = 1})) == Approx(pi));
  p.normal = unit(V3(1, 0, 1));
  CHECK(total(sun.irradiance(p, {.rays = 1})) == Approx(pi * std::sqrt(0.5)));
  p.normal = p.face = {0, 0, -1};
  CHECK(total(sun.irradiance(p, {.rays = 1})) == 0);
  Room half("PointLight { location 0 0 1 intensity 0.5 color 1 0.5 0 }");
  Irradiance e = half.irradiance(up, {.rays = 1});
  CHECK(e.direct[0] == Approx(pi * 0.2140411));  // sRGB 0.5
  CHECK(e.direct[1] == Approx(pi * 0.0508761));  // sRGB 0.25
  CHECK(e.direct[2] == 0);
  CHECK(total(Room("PointLight { location 0 0 1 radius 0.9 }").irradiance(up, {.rays = 1})) == 0);
  CHECK(total(Room("PointLight { location 0 0 1 on FALSE } DirectionalLight { on FALSE }",
                   {.sky = LightOptions::Sky::none})
                  .irradiance(up, {.rays = 1})) == 0);
}

TEST_CASE("light: a SpotLight's cone") {
  Room room("SpotLight { location 0 0 1 direction 0 0 -1 beamWidth 0.2 cutOffAngle 0.6 }");
  auto at_angle = [&](double a) {
    Point p = up;
    p.position = {std::tan(a), 0, 0};
    return total(room.irradiance(p, {.rays = 1})) / (pi * std::cos(a));
  };
  CHECK(at_angle(0.1) == Approx(1));
  CHECK(at_angle(0.4) == Approx(0.5));
  CHECK(at_angle(0.61) == 0);
}

TEST_CASE("light: a DirectionalLight lights what is below its parent") {
  std::string plate = quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, material(0.5));
  Room room("Group { children [ DirectionalLight { direction 0 0 -1 } " + plate +
            " ] } Transform { translation 5 0 0 children " + plate + " }");
  Point in = up, out{{5, 0, 0}, {0, 0, 1}, {0, 0, 1}, 1};
  in.use = 0;
  CHECK(total(room.irradiance(in, {.rays = 1})) == Approx(pi));
  CHECK(total(room.irradiance(out, {.rays = 1})) == 0);
}

TEST_CASE("light: many lamps, of which few get a ray") {
  std::string lamps;
  Stream random(3);
  for (int i = 0; i < 300; ++i)
    lamps += fmt::format("PointLight {{ location {} {} {} attenuation 0 0 1 intensity {} radius 1000 }} ",
                         20 * random.next() - 10, 20 * random.next() - 10, 1 + 5 * random.next(), random.next());
  Room room(lamps + quad({-1, -1, 0.5}, {2, 0, 0}, {0, 2, 0}, material(0)));
  double sum = 0, expected = 0;
  std::vector<Point> points;
  for (int i = 0; i < 2000; ++i) points.push_back({{0.0001 * i, 2, 0}, {0, 0, 1}, {0, 0, 1}});
  for (const auto& e : room.irradiance(points, {.rays = 1})) sum += total(e) / 2000;
  for (const Point& p : points)
    for (const Lamp& l : room.world->lamps()) {
      auto a = drawing::arrival(l.light, p.position);
      if (room.world->transmittance({p.position, a.to_light}, a.distance) > 0)
        expected += mean(l.irradiance) * a.strength * a.to_light.z / 2000;
    }
  CHECK(sum == Approx(expected).epsilon(0.005));
}

TEST_CASE(
    "light: what few emitters give where nothing stands between has no noise, strong ones and faint ones together") {
  std::string lights;
  for (int i = 0; i < 6; ++i) lights += quad({2.0 * i - 0.5, -0.5, 1}, {0, 1, 0}, {1, 0, 0}, emitting);
  Room room(lights);
  const double exact = total(room.irradiance(up, {.rays = 4096}));
  for (int rays : {2, 3, 6, 10})
    for (const Irradiance& e : room.irradiance(std::vector<Point>(20, up), {.rays = rays}))
      CHECK(total(e) == Approx(exact).epsilon(1e-6));
}

TEST_CASE("light: of faint emitters behind a wall the noise is told, and the mean is right") {
  std::string lights = quad({-0.8, -0.5, 0.5}, {0, 1, 0}, {0.9, 0, 0}, material(0));  // hides some of them
  for (int i = 0; i < 9; ++i) lights += quad({-4 + i - 0.2, -0.2, 2}, {0, 0.4, 0}, {0.4, 0, 0}, emitting);
  Room room(lights);
  const double expected = total(room.irradiance(up, {.rays = 8192}));
  double sum = 0, squares = 0, told = 0;
  constexpr int n = 2000;
  for (const Irradiance& e : room.irradiance(std::vector<Point>(n, up), {.rays = 6})) {
    sum += total(e);
    squares += total(e) * total(e);
    told += deviation(e) * deviation(e);
  }
  const double mean = sum / n, variance = squares / n - mean * mean;
  CHECK(mean == Approx(expected).margin(4 * std::sqrt(variance / n)));
  CHECK(variance > 0);
  CHECK(told / n > 0.7 * variance);
}

TEST_CASE("light: many emitters, chosen by what they give") {
  std::string lights;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k) lights += quad({i - 10.0, k - 10.0, 1.0}, {0, 0.2, 0}, {0.2, 0, 0}, emitting);
  Room room(lights);
  double expected = 0;
  for (const Emitter& e : room.world->emitters()) {
    // Small enough for its middle to stand for it, but for 0.3 %.
    constexpr int n = 8;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n - a; ++b)
        for (int half = 0; half < (a + b < n - 1 ? 2 : 1); ++half) {
          V3 p = e.at((a + (half ? 2. : 1.) / 3) / n, (b + (half ? 2. : 1.) / 3) / n);
          expected += e.area() / (n * n) * p.z * p.z / std::pow(dot(p, p), 2);
        }
  }
  CHECK(room.world->emitters().size() == 800);
  check("400 squares", room, up, expected);
}

// ---- surfaces ------------------------------------------------------------------------------------------------------

TEST_CASE("light: what is transparent lets light through") {
  std::string lamp = "PointLight { location 0 0 4 } ",
              glass = "appearance Appearance { material Material { transparency 0.25 diffuseColor 0 0 0 } } ";
  Room room(lamp + quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, glass) + quad({-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, glass));
  CHECK(total(room.irradiance(up, {.rays = 1})) == Approx(pi * 0.0625));
  LightOptions white{.sky = LightOptions::Sky::constant};
  Room dome(quad({-1e4, -1e4, 1}, {2e4, 0, 0}, {0, 2e4, 0}, glass), white);
  check("sky through glass", dome, up, pi * 0.25);
  Room shut(lamp + quad({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, glass) +
            quad({-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, material(0)));
  CHECK(total(shut.irradiance(up, {.rays = 1})) == 0);
}

TEST_CASE("light: among many panes of white glass under a white sky it is white everywhere") {
  // Each reflection meets eight panes, each of which reflects: were all followed, there would be no end.
  std::string panes;
  for (int k = 1; k <= 8; ++k)
    panes +=
        quad({-1, -1, 0.1 * k}, {2, 0, 0}, {0, 2, 0},
             "appearance Appearance { material Material { transparency 0.7 diffuseColor 1 1 1 } } ", "solid FALSE");
  for (auto mode : {Mode::cached, Mode::path}) {
    Room room(panes, {.sky = LightOptions::Sky::constant});
    CHECK(total(room.irradiance(up, {.mode = mode, .rays = 4096})) == Approx(pi).epsilon(0.02));
  }
}

TEST_CASE("light: the back of a solid face is black, of another one not") {
  // A ceiling seen from below, lit from below by reflection of a floor that emits.
  for (bool solid : {true, false}) {
    Room room(quad({-50, -50, -1}, {100, 0, 0}, {0, 100, 0}, material(0, 1)) +
              quad({-50, -50, 1}, {100, 0, 0}, {0, 100, 0}, material(0.5), solid ? "solid TRUE" : "solid FALSE"));
    Irradiance e = room.irradiance(up, {.rays = 1024});
    CHECK(total(e) == Approx(solid ? 0 : 0.5 * pi).epsilon(0.01).margin(1e-9));
    CHECK(e.inside == Approx(solid ? 1 : 0).margin(0.05));
  }
  Room emits(quad({-50, -50, 1}, {100, 0, 0}, {0, 100, 0}, emitting, "solid FALSE"));
  CHECK(total(emits.irradiance(up, {.rays = 1024})) == Approx(pi).epsilon(0.01));
}

TEST_CASE("light: behind a pane of glass nobody is within it") {
  const std::string glass = "appearance Appearance { material Material { transparency 0.5 diffuseColor 0 0 0 } } ";
  Room pane("Transform { translation 0 0 1 children Shape { " + glass + "geometry Box { size 1000 1000 0.1 } } }",
            {.sky = LightOptions::Sky::constant});
  Irradiance e = pane.irradiance(up, {.rays = 256});
  CHECK(e.inside == 0);
  CHECK(total(e) == Approx(0.25 * pi).epsilon(0.02));
  Room jar("Shape { " + glass + "geometry Sphere { radius 3 } }", {.sky = LightOptions::Sky::constant});
  e = jar.irradiance(up, {.rays = 256});
  CHECK(e.inside == 0);
  CHECK(total(e) == Approx(0.5 * pi).epsilon(0.02));
}

TEST_CASE("light: what is mirrored emits to the front, as it does elsewhere") {
  const std::string lamp = quad({-50, -50, 1}, {0, 100, 0}, {100, 0, 0}, emitting),
                    body = "Transform { scale -1 1 1 children " + lamp + "}";
  CHECK(total(Room(body).irradiance(up, {.rays = 256})) == Approx(pi).epsilon(0.01));
  CHECK(total(Room(lamp).irradiance(up, {.rays = 256})) == Approx(pi).epsilon(0.01));
  const std::string turned =
      "Transform { scale -1 1 1 children " + quad({-50, -50, 1}, {100, 0, 0}, {0, 100, 0}, emitting) + "}";
  CHECK(total(Room(turned).irradiance(up, {.rays = 256})) == 0);
}

TEST_CASE("light: Shapes without Material") {
  std::string plain = quad({-50, -50, 1}, {0, 100, 0}, {100, 0, 0}, ""),
              body = plain + "DirectionalLight { direction 0 0 1 }";
  Room reflects(body), emits(body, {.emission = 0.5, .unlit_emits = true});
  Hit hit;
  REQUIRE(reflects.world->nearest({{0, 0, 0}, {0, 0, 1}}, 0, hit));
  CHECK(reflects.world->surface(hit).albedo.x == Approx(0.99));
  CHECK(reflects.world->surface(hit).emission.x == 0);
  CHECK(emits.world->surface(hit).emission.x == Approx(0.5));
  CHECK(total(emits.irradiance(up, {.rays = 1024})) == Approx(0.5 * pi).epsilon(0.01));
}

TEST_CASE("light: reflectance is read from the texture, not from its mean") {
  // Left half black, right half white; s runs along x.
  std::string texture =
      "appearance Appearance { material Material { diffuseColor 1 1 1 } texture PixelTexture { image 2 1 1 0x00 0xFF "
      "repeatS FALSE } } ";
  Room room(
      quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, texture, "texCoord TextureCoordinate { point [ 0 0, 1 0, 1 1, 0 1 ] }"));
  Hit hit;
  REQUIRE(room.world->nearest({{-0.9, 0, 1}, {0, 0, -1}}, 0, hit));
  CHECK(room.world->surface(hit).albedo.x == Approx(0).margin(1e-6));
  REQUIRE(room.world->nearest({{0.9, 0, 1}, {0, 0, -1}}, 0, hit));
  CHECK(room.world->surface(hit).albedo.x == Approx(0.99));
}

TEST_CASE("light: a sky from Background, or of its own") {
  Room blue("Background { skyColor 0 0 1 }"), bare(""), none("", {.sky = LightOptions::Sky::none}),
      lit("PointLight { }");
  Irradiance e = blue.irradiance(up, {.rays = 64});
  CHECK(e.gathered[2] == Approx(pi));
  CHECK(e.gathered[0] == 0);
  CHECK_FALSE(bare.world->has_sky_of_its_own());
  CHECK(total(bare.irradiance(up, {.rays = 64})) == Approx(pi));
  CHECK(total(none.irradiance(up, {.rays = 64})) == 0);
  CHECK(lit.world->has_sky_of_its_own());
  CHECK_FALSE(lit.world->has_sky());
}

TEST_CASE("light: a white sky stands in for light that is too little to see by") {
  const std::string floor = quad({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, material(0.5));  // 16 square metres
  auto glow = [&](double side, const std::string& color, const LightOptions& options = {}) {
    const std::string surface = "appearance Appearance { material Material { emissiveColor " + color + " } } ";
    return !Room(floor + quad({1, 1, 1}, {0, side, 0}, {side, 0, 0}, surface), options).world->has_sky_of_its_own();
  };
  CHECK(glow(2, "0.49 0.49 0.49"));  // as CAD programs make paint glow
  CHECK_FALSE(glow(2, "0.51 0.51 0.51"));
  CHECK_FALSE(glow(2, "0.51 0 0"));
  CHECK_FALSE(glow(2, "0.1 0.1 0.1", {.emission = 30}));
  CHECK(glow(2, "1 1 1", {.emission = 0.1}));
  CHECK_FALSE(glow(0.26, "1 1 1"));  // 1/237 of the area; a bulb that lights little but itself is less
  CHECK(glow(0.24, "1 1 1"));        // 1/279
  CHECK_FALSE(glow(0.24, "1 1 1", {.emission = 2}));
  CHECK_FALSE(glow(2, "0.1 0.1 0.1", {.sky = LightOptions::Sky::none}));

  Room night("Background { }"), dusk("Background { skyColor 0.1 0.1 0.2 }"),
      top("Background { skyColor [ 1 1 1, 0 0 0 ] skyAngle 0.01 }");
  CHECK_FALSE(night.world->has_sky_of_its_own());
  CHECK(total(night.irradiance(up, {.rays = 64})) == Approx(pi));
  CHECK(dusk.world->has_sky_of_its_own());
  CHECK_FALSE(top.world->has_sky_of_its_own());
}

// ---- walls ---------------------------------------------------------------------------------------------------------

TEST_CASE("light: none gets through closed walls") {
  // Two rooms on one floor, a wall of 1 cm between; one is bright. Far from the origin, too.
  for (double away : {0.0, 1e5}) {
    auto box = [](const V3& low, const V3& high, const std::string& s) {
      V3 d = high - low, x{d.x, 0, 0}, y{0, d.y, 0}, z{0, 0, d.z};
      return quad(low, x, z, s) + quad(low + y, z, x, s) + quad(low, z, y, s) + quad(low + x, y, z, s) +
             quad(low + z, x, y, s) + quad(low, y, x, s);
    };
    std::string rooms;
    for (const auto& [low, high] : {std::pair{V3(0, 0, -0.1), V3(8, 4, 0)},
                                    {V3(0, 0, 3), V3(8, 4, 3.1)},
                                    {V3(0, -0.1, 0), V3(8, 0, 3)},
                                    {V3(0, 4, 0), V3(8, 4.1, 3)},
                                    {V3(-0.1, -0.1, -0.1), V3(0, 4.1, 3.1)},
                                    {V3(8, -0.1, -0.1), V3(8.1, 4.1, 3.1)},
                                    {V3(4, -0.05, -0.05), V3(4.01, 4.05, 3.05)}})
      rooms += box(low, high, material(0.8));
    Room room(
        fmt::format("Transform {{ translation {} 0 0 children [ {} PointLight {{ location 2 2 2 }} ] }}", away, rooms));
    std::vector<Point> points;
    for (int i = 0; i < 32; ++i)
      for (int k = 0; k < 16; ++k)
        points.push_back({{away + 0.125 + 0.25 * i, 0.125 + 0.25 * k, 0}, {0, 0, 1}, {0, 0, 1}});
    for (Mode mode : {Mode::cached, Mode::path}) {
      double bright = 0, dark = 0;
      auto e = room.irradiance(points, {.mode = mode, .rays = 64});
      for (std::size_t i = 0; i < points.size(); ++i) (points[i].position.x < away + 4 ? bright : dark) += total(e[i]);
      CHECK(bright > 0);
      CHECK(dark <= (mode == Mode::path ? 0 : 1e-4 * bright));
    }
  }
}

TEST_CASE("light: the sides of a thin plate are lit apart") {
  Room room("PointLight { location 0 0 1 } " + quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, material(0.5), "solid FALSE"));
  Point below{{0, 0, 0}, {0, 0, -1}, {0, 0, -1}};
  CHECK(total(room.irradiance(up, {.rays = 1})) == Approx(pi));
  CHECK(total(room.irradiance(below, {.rays = 1})) == 0);
}

// ---- promises ------------------------------------------------------------------------------------------------------

namespace {

const std::string furnished =
    cube(material(0.6), material(0.6)) + quad({0.3, 0.3, 0.99}, {0, 0.4, 0}, {0.4, 0, 0}, emitting) +
    "PointLight { location 0.2 0.2 0.8 } DEF Ball Transform { translation 0.5 0.5 0.2 scale 0.2 0.2 0.2 children Shape "
    "{ " +
    material(0.7) + " geometry Sphere { } } } Transform { translation 0.3 -0.2 0.2 children USE Ball }";

std::vector<Point> floor_points() {
  std::vector<Point> points;
  for (int i = 0; i < 400; ++i) points.push_back({{(i % 20 + 0.5) / 20, (i / 20 + 0.5) / 20, 0}, {0, 0, 1}, {0, 0, 1}});
  return points;
}

}  // namespace

TEST_CASE("light: the same bits on any number of threads, and in pieces") {
  auto on = [&](std::size_t threads) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Room room(furnished);
    return room.irradiance(floor_points(), {.rays = 16});
  };
  auto one = on(1), four = on(4);
  bool same = true;
  for (std::size_t i = 0; i < one.size(); ++i)
    same &= one[i].direct == four[i].direct && one[i].gathered == four[i].gathered &&
            one[i].gathered_variance == four[i].gathered_variance;
  CHECK(same);
  Room room(furnished);
  auto points = floor_points();
  Integrator integrator(*room.world, points, {.rays = 8});
  auto whole = integrator.irradiance(points), part = integrator.irradiance(std::span(points).subspan(130, 7), 130);
  for (std::size_t i = 0; i < part.size(); ++i) CHECK(part[i].gathered == whole[130 + i].gathered);
}

TEST_CASE("light: instances are lit as copies are") {
  Room copies(furnished), instances(furnished, {.all_flat = 0});
  double a = 0, b = 0;
  for (const auto& e : copies.irradiance(floor_points(), {.rays = 64})) a += total(e);
  for (const auto& e : instances.irradiance(floor_points(), {.rays = 64})) b += total(e);
  CHECK(a == Approx(b).epsilon(0.005));
}

TEST_CASE("light: rays that go on where others ended are others, and give the same light") {
  Room room(furnished);
  const auto points = floor_points();
  const Integrator light(*room.world, points, {.rays = 64});
  const auto all = light.irradiance(points, 0), one = light.irradiance(points, 0, {64, 64});
  double mean[2] = {}, apart = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    mean[0] += total(all[i]);
    mean[1] += total(one[i]);
    apart += std::fabs(total(all[i]) - total(one[i]));
  }
  CHECK(apart > 0);
  CHECK(mean[1] == Approx(mean[0]).epsilon(0.01));
}

TEST_CASE("light: directions of what arrives") {
  // From straight above all of it; from a whole sky of radiance 1 the integral of cos^2 is 2 pi / 3.
  Irradiance lamp = Room("PointLight { location 0 0 1 }").irradiance(up, {.rays = 1}),
             sky = Room("").irradiance(up, {.rays = 4096});
  CHECK(lamp.along[2][0] == Approx(pi));
  CHECK(lamp.along[0][0] == Approx(0).margin(1e-6));
  CHECK(sky.along[2][1] == Approx(2 * pi / 3).epsilon(0.002));
  CHECK(sky.along[1][1] == Approx(0).margin(0.005));
}
