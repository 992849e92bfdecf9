// Light of VRML: its lights, its surfaces, walls; and promises that hold for all of them.
#include "tests/unit/light_fixture.h"

using namespace wrlkit;
using namespace wrlkit::light_tests;
using namespace wrlkit::light;

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
  RandomStream random(3);
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
    // Small enough for its middle to stand for it, within 0.3 %.
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

TEST_CASE("light: none gets through the wall between a room and a closet, however large the world is") {
  std::string world = quad({-30, -30, -5}, {0, 60, 0}, {60, 0, 0}, material(0.5));
  std::vector<Point> points;
  std::vector<char> is_closet;
  const auto add = [&](double x, double width, bool closet) {
    const std::string box = cube(material(0.95), material(0.95));
    world += fmt::format("Transform {{ translation {} 0 0 scale {} 3 2.5 children [ {} ] }}\n", x, width, box);
    if (!closet) world += fmt::format("PointLight {{ location {} 1.5 2 attenuation 0 0 1 }}\n", x + 1.5);
    const int n = closet ? 60 : 400;
    Lattice<2> places(7);
    for (int i = 0; i < n; ++i) {
      const auto [u, v] = places[static_cast<std::uint32_t>(i)];
      points.push_back({{x + u * width, 3 * v, 0}, {0, 0, 1}, {0, 0, 1}});
      is_closet.push_back(closet);
    }
  };
  for (int k = 0; k < 6; ++k) {
    add(3.7 * k - 10, 3, false);
    add(3.7 * k - 6.9, 0.5, true);
  }
  const auto light = Room(world).irradiance(points, {.rays = 64});
  double room = 0, closet = 0;
  for (std::size_t i = 0; i < light.size(); ++i) (is_closet[i] ? closet : room) += total(light[i]);
  CHECK(room > 0);
  CHECK(closet / 60 < 0.001 * room / 400);
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
  const Room reflects(body);
  Hit hit;
  REQUIRE(reflects.world->nearest({{0, 0, 0}, {0, 0, 1}}, 0, hit));
  CHECK(reflects.world->surface(hit).albedo.x == Approx(0.99));
  CHECK(reflects.world->surface(hit).emission.x == 0);
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
