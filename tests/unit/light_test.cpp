// Light against closed formulas: form factors, furnaces, lamps, skies with walls; by the cached integrator and by path
// tracing. Seeds are fixed. Each value is checked twice: within 0.5 % with many rays, and within three standard errors
// with few. Of seeds 99.7 % would pass the second if errors were normal and the variance exact; it is an upper bound,
// so more do. It does not know the error of the cache, for which 0.5 % is allowed as well.
#include "tests/unit/light_fixture.h"

using namespace wrlkit;
using namespace wrlkit::light_tests;
using namespace wrlkit::light;

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

TEST_CASE("light: a PointLight shines through the glass that shines around it, and through no other") {
  const std::string lamp = "PointLight { location 0 0 2 attenuation 0 0 1 }",
                    floor = "Transform { translation 0 0 -1 children Shape { geometry Box { size 9 9 0.1 } } }";
  const auto around = [](std::string_view look, double size) {
    return fmt::format(
        " Transform {{ translation 0 0 2 children Shape {{ appearance Appearance {{ material Material {{ {} }} }} "
        "geometry Box {{ size {} {} {} }} }} }}",
        look, size, size, size);
  };
  const auto irradiance = [&](const std::string& what) {
    return total(Room(lamp + floor + what).irradiance(up, {.rays = 64}));
  };
  const std::string shining = "diffuseColor 0 0 0 emissiveColor 1 1 1",
                    faint = "diffuseColor 0 0 0 emissiveColor 0.3 0.3 0.3";
  const double bare = irradiance("");
  const std::string elsewhere =
      " Transform { translation 0 0 1 children Shape { appearance Appearance { material "
      "Material { diffuseColor 0 0 0 emissiveColor 1 1 1 } } geometry Box { size 0.1 0.1 0.1 } } }";
  CHECK(irradiance(around(shining, 0.1)) > bare);
  CHECK(irradiance(around("diffuseColor 0 0 0", 0.1)) < 0.01 * bare);
  CHECK(irradiance(around(faint, 0.1)) < 0.1 * bare);
  CHECK(irradiance(elsewhere) < 0.5 * bare);
  // Walls that glow are no bulb.
  const auto walls = floor + around(shining, 3);
  CHECK(irradiance(around(shining, 3)) == Approx(total(Room(walls).irradiance(up, {.rays = 64}))));
}

TEST_CASE("light: a PointLight in the plane of a ceiling shines at all of the floor") {
  const std::string ceiling = "Transform { translation 0.3 0.1 3.05 children Shape { geometry Box { size 7 7 0.1 } } }";
  const std::string lamp = "PointLight { location 0.1 0.2 3 attenuation 0 0 1 }";
  const Room bare(lamp), room(lamp + ceiling);
  for (int i = 0; i < 100; ++i) {
    const Point floor{{0.057 * i - 2.7, 0.031 * i - 1.5, 0}, {0, 0, 1}};
    CHECK(total(room.irradiance(floor, {.rays = 1})) >= Approx(total(bare.irradiance(floor, {.rays = 1}))));
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
  } cases[] = {{0.1, 0.5, 0.5, 0.2}, {0.5, 0.8, 0.8, 2.5}, {0.25, 0.3, 0.9, 1}};
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
