// The pass `lightmap` from world to picture: closed formulas, leaks, seams, both sides, and the same bytes on any
// number of threads.
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;

TEST_CASE("bake: the white furnace is as bright everywhere", "[bake]") {
  // Radiance L = emission + albedo L.
  Baked b("DEF Room Shape { " + material(0.5, 0.25) + " geometry " + box(true, 1) + " }", "quality=normal,max-size=64");
  Light room(b, "Room");
  for (std::size_t i = 0; i < room.mesh.corners.size() / 3; ++i)
    for (auto [u, v] : {std::pair{0.02, 0.02}, {0.96, 0.02}, {0.3, 0.3}, {0.02, 0.96}})
      CHECK(room.at(i, u, v) == Approx(0.5).epsilon(0.03));
}

TEST_CASE("bake: a lamp over a floor, by the inverse square", "[bake]") {
  Baked b("DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
              " } PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  Light floor(b, "Floor");
  for (double r : {0.0, 0.5, 1.0, 1.5})
    CHECK(floor.on_floor(r, 0.01) == Approx(2 / std::pow(4 + r * r, 1.5)).epsilon(0.02));
}

TEST_CASE("bake: light lies where it does though a scale mirrors the surface", "[bake]") {
  Baked b("Transform { scale -1 1 1 children DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
              " } } PointLight { location 1 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  Light floor(b, "Floor");
  for (double r : {0.0, 0.5, 1.0, 1.5})
    CHECK(floor.on_floor(-1 + r, 0.01) == Approx(2 / std::pow(4 + r * r, 1.5)).epsilon(0.02));
}

TEST_CASE("bake: no light comes into a closed room", "[bake]") {
  Baked b("DEF In Shape { " + material(0.8) + " geometry " + box(true, 1) + " } DEF Out Shape { " + material(0.8) +
              " geometry " + box(false, 1.1) + " }",
          "quality=draft,max-size=128,sky=1:1:1");
  Light in(b, "In"), out(b, "Out");
  for (std::size_t i = 0; i < in.mesh.corners.size() / 3; ++i)
    for (auto [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.3, 0.3}}) {
      CHECK(in.at(i, u, v) < 1e-3);
      CHECK(out.at(i, u, v) == Approx(1).epsilon(0.05));
    }
}

TEST_CASE("bake: both sides of a thin plate have light of their own", "[bake]") {
  Baked b("DEF Plate Shape { " + material(0.5) +
              " geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ -2 0 -2, -2 0 2, 2 0 2, 2 0 -2 ] } "
              "coordIndex [ 0 1 2 3 -1 ] } } PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  Light plate(b, "Plate");
  REQUIRE(plate.mesh.corners.size() == 12);
  CHECK(plate.mesh.solid);
  CHECK(plate.at(std::size_t{0}, 0.3, 0.3) > 0.1);
  CHECK(plate.at(std::size_t{2}, 0.3, 0.3) == 0);
}

TEST_CASE("bake: the light of a smooth surface goes on across a cut", "[bake]") {
  Baked b("DEF Pipe Shape { " + material(0.5) +
              " geometry Cylinder { top FALSE bottom FALSE } } PointLight { location 2 1 2 attenuation 0 0 1 }",
          "quality=normal,max-size=128,sky=0.2:0.2:0.2");
  Light pipe(b, "Pipe");
  std::map<std::array<double, 3>, std::vector<double>> shown;
  for (std::size_t c = 0; c < pipe.mesh.corners.size(); ++c) {
    const double* p = pipe.mesh.positions.data() + 3 * std::size_t{pipe.mesh.corners[c]};
    const float* l = pipe.mesh.lightcoord.at(pipe.mesh.lightcoord.index[c]);
    shown[{p[0], p[1], p[2]}].push_back(pipe.at(l[0], l[1]));
  }
  std::size_t n_cut = 0;
  for (auto& [p, light] : shown) {
    auto [low, high] = std::ranges::minmax(light);
    n_cut += low != high;
    CHECK(high - low < 0.02);
  }
  CHECK(n_cut >= 1);
}

TEST_CASE(
    "bake: shared geometry has light of its own at each place, and the same bytes come from any number of threads",
    "[bake]") {
  const std::string world =
      "DEF A Shape { " + material(0.5) + " geometry DEF G " + floor_of_4 +
      " } Transform { translation 0 0 50 children USE A } PointLight { location 0 2 0 attenuation 0 0 1 }";
  std::vector<std::string> pictures;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    Baked b(world, "quality=draft,max-size=128");
    const Scene& scene = b.world->scene;
    CHECK(scene.get(b.shape("A"), nodes::shape::geometry) == scene.get(b.shape("A_2"), nodes::shape::geometry));
    REQUIRE(b.resources.made().size() == 1);
    pictures.push_back(*b.resources.made()[0].bytes);
    // One place is bright and the other dark.
    auto place = [&](const char* name) {
      const NodeId a = scene.get(b.shape(name), nodes::shape::appearance);
      return scene.get(scene.get(a, nodes::appearance::lightmapTransform), nodes::texture_transform::translation);
    };
    CHECK(place("A") != place("A_2"));
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("bake: directions are the same bytes on any number of threads, in the dark, too", "[bake]") {
  // Behind the wall next to nothing arrives, and numbers near the smallest there are decide where from.
  const std::string world =
      "PointLight { location 0 3 5 } Transform { translation 4 -2 0 children Shape { appearance Appearance { material "
      "Material { transparency 0.5 "
      "diffuseColor 1 0.5 0 emissiveColor 0 0 0.3 } } geometry Sphere { radius 1.5 } } } Transform { translation 0 0 "
      "-3 children Shape { " +
      material(0.6) + " geometry Box { size 14 10 0.1 } } }";
  std::vector<std::vector<std::string>> pictures;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    Baked b(world, "quality=draft,max-size=128,directional=true");
    REQUIRE(b.resources.made().size() == 4);
    auto& all = pictures.emplace_back();
    for (const auto& m : b.resources.made()) all.push_back(*m.bytes);
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("bake: under what is closed the floor takes the light around, though both sides of it were to be seen",
          "[bake]") {
  const std::string block = "Transform { translation 0 1 0 children DEF Block Shape { " + material(0.5) +
                            " geometry IndexedFaceSet { solid FALSE " + box(false, 1).substr(17) + " } }";
  Baked b("DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 + " } " + block,
          "quality=draft,max-size=128,sky=1:1:1");
  Light floor(b, "Floor"), top(b, "Block");
  CHECK(top.mesh.corners.size() == 36);  // the inner side is not lit
  CHECK(floor.on_floor(0.01, 0.02) > 0.2);
  CHECK(b.stats["lightmap.inside"] > 500);
  CHECK(b.stats["lightmap.black"] == 0);
  CHECK(b.stats["lightmap.leaks"] == 0);
  CHECK(b.stats["lightmap.jumps"] == 0);
}

TEST_CASE("bake: the dark below a hood of single sheets makes no seam along its foot", "[bake]") {
  // Its walls meet the texels of the floor at a slant. Outside half of the sky is seen there.
  const std::string hood =
      "IndexedFaceSet { solid FALSE coord Coordinate { point [ -1 -1 -1, 1 -1 -1, 1 -1 1, -1 -1 1, 0 1 0 ] } "
      "coordIndex [ 0 1 4 -1 1 2 4 -1 2 3 4 -1 3 0 4 -1 ] }";
  const std::string world = "DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
                            " } Transform { translation 0 1 0 rotation 0 1 0 0.4 children Shape { " + material(0.5) +
                            " geometry " + hood + " } }";
  for (const std::string quality : {"draft", "normal"}) {
    Baked b(world, "sky=1:1:1,max-size=128,mips=1,denoise=false,quality=" + quality);
    Light floor(b, "Floor");
    double least = 1, most_within = 0;
    for (int k = 1; k < 100; ++k) {
      const double along = -1 + k / 50.0, c = std::cos(0.4), s = std::sin(0.4);
      auto at = [&](double x, double z) { return floor.on_floor(c * x + s * z, c * z - s * x); };
      for (double side : {-1.001, 1.001}) least = std::min({least, at(side, along), at(along, side)});
      for (double side : {-0.8, 0.8})
        most_within = std::max({most_within, at(side, 0.8 * along), at(0.8 * along, side)});
    }
    INFO(quality);
    CHECK(least > 0.25);
    CHECK(most_within < 0.01);
  }
}

TEST_CASE("bake: a closed room of which both sides are to be seen has light on both when somebody stands in it",
          "[bake]") {
  const std::string room = "DEF Room Shape { " + material(0.5, 0.1) + " geometry IndexedFaceSet { solid FALSE " +
                           box(true, 1).substr(17) + " } ";
  Baked nobody(room, "quality=draft,max-size=128"),
      viewer(room + "Viewpoint { position 0 0 0.5 }", "quality=draft,max-size=128"),
      lamp(room + "PointLight { location 0 0.5 0 }", "quality=draft,max-size=128");
  CHECK(Light(nobody, "Room").mesh.corners.size() == 36);
  CHECK(Light(viewer, "Room").mesh.corners.size() == 72);
  CHECK(Light(lamp, "Room").mesh.corners.size() == 72);
}

TEST_CASE(
    "bake: an error that is asked for costs rays, where they are needed, and the same bytes come from any number of "
    "threads") {
  const std::string body =
      "DEF Room Shape { " + material(0.5) + " geometry " + box(true, 1) + " } DEF Block Shape { " + material(0.5) +
      " geometry " + box(false, 0.3) +
      " } Transform { translation 0 0.95 0 rotation 1 0 0 3.14159265 scale 0.2 0.2 0.2 children Shape { " +
      material(0, 1) + " geometry " + floor_of_4 + " } }";
  auto rays = [&](const std::string& error) {
    return Baked(body, "quality=draft,max-size=64" + error).stats["lightmap.rays"];
  };
  const auto coarse = rays(",error=0.5"), fine = rays(",error=0.01");
  CHECK(coarse < 2 * rays(""));
  CHECK(fine > 3 * coarse);
  std::vector<std::string> pictures;
  for (int threads : {1, 2}) {
    ThreadLimit limit(threads);
    Baked b(body, "quality=draft,max-size=64,error=0.02");
    pictures.push_back(*b.resources.made()[0].bytes);
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("bake: a solid thing that is wound inside out has the light of its outside where viewers see it") {
  const std::string thing = "DEF Thing Shape { " + material(0.5) + " geometry " + box(true, 1) + " } ",
                    white = "quality=draft,max-size=128,sky=1:1:1";
  Baked b(thing, white);
  Light light(b, "Thing");
  REQUIRE(light.mesh.corners.size() == 36);
  for (std::size_t i = 0; i < 12; ++i) CHECK(light.at(i, 0.3, 0.4) == Approx(1).epsilon(0.02));
  CHECK(b.diag.count(Diag::inside_out) == 1);
  // It looks inward as before.
  CHECK(light.mesh.solid);
  double volume = 0;
  for (std::size_t c = 0; c < 36; c += 3)
    volume += dot(corner(light.mesh, c), cross(corner(light.mesh, c + 1), corner(light.mesh, c + 2)));
  CHECK(volume * (light.mesh.ccw ? 1 : -1) == Approx(-48));
  // One to stand in is a room, and dark.
  for (const char* within :
       {"Viewpoint { position 0 0 0.5 }",
        "Shape { appearance Appearance { material Material { } } geometry Sphere { radius 0.1 } }"}) {
    Baked room(thing + within, white);
    CHECK(Light(room, "Thing").at(0, 0.3, 0.4) == 0);
    CHECK(room.diag.count(Diag::inside_out) == 0);
  }
}

TEST_CASE("bake: of closed things in one geometry that are wound against one another each has light on its outside") {
  const std::string cube = "-1 -1 -1, 1 -1 -1, -1 1 -1, 1 1 -1, -1 -1 1, 1 -1 1, -1 1 1, 1 1 1, ",
                    other = "4 4 4, 5 4 4, 4 5 4, 5 5 4, 4 4 5, 5 4 5, 4 5 5, 5 5 5";
  const std::string outward = "0 2 3 1 -1 4 5 7 6 -1 0 1 5 4 -1 2 6 7 3 -1 0 4 6 2 -1 1 3 7 5 -1 ",
                    inward = "9 11 10 8 -1 14 15 13 12 -1 12 13 9 8 -1 11 15 14 10 -1 10 14 12 8 -1 13 15 11 9 -1";
  Baked b("DEF Two Shape { " + material(0.5) + " geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ " +
              cube + other + " ] } coordIndex [ " + outward + inward + " ] } }",
          "quality=draft,max-size=128,sky=1:1:1");
  Light light(b, "Two");
  REQUIRE(light.mesh.corners.size() == 2 * 72);
  const auto& m = light.mesh;
  for (std::size_t i = 0; i < 48; ++i) {
    const auto a = corner(m, 3 * i), from = a - drawing::V3(a.x > 3 ? 4.5 : 0),
               across = cross(corner(m, 3 * i + 1) - a, corner(m, 3 * i + 2) - a);
    CHECK(light.at(i, 0.3, 0.4) == Approx(dot(from, across) * (m.ccw ? 1 : -1) > 0 ? 1 : 0).margin(0.05));
  }
}

TEST_CASE("bake: dim ground under water makes no fringe along the shore") {
  const std::string water =
      "Shape { appearance Appearance { material Material { diffuseColor 0 0 0 transparency 0.2 } } geometry "
      "IndexedFaceSet { solid FALSE coord Coordinate { point [ -9 0 -9, -9 0 9, 9 0 9, 9 0 -9 ] } coordIndex [ 0 1 2 3 "
      "-1 ] } } ";
  Baked b(water +
              "Transform { rotation 0 1 0 0.3 children Transform { rotation 0 0 1 0.4 children DEF Ground Shape { " +
              material(0) + " geometry " + floor_of_4 + " } } }",
          "quality=draft,max-size=128,sky=1:1:1,denoise=false");
  Light ground(b, "Ground");
  double dry = 0, shore = 10;
  for (int k = 0; k < 100; ++k) {
    const double z = -1.5 + 0.03 * k;
    dry += ground.on_floor(1, z) / 100;
    shore = std::min(shore, ground.on_floor(0.005, z));
  }
  CHECK(ground.on_floor(-1, 0) < 0.4 * dry);
  CHECK(shore > 0.6 * dry);
}

TEST_CASE("bake: what stands in a glass has light of its own, and the glass has it on both sides") {
  const std::string glass =
      "appearance Appearance { material Material { transparency 0.5 } } geometry IndexedFaceSet { solid FALSE " +
      box(false, 2).substr(17);
  Baked b("DEF In Shape { " + material(0.5) + " geometry " + box(false, 1) + " } DEF Glass Shape { " + glass +
              " } PointLight { location 0 5 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128,sky=0:0:0");
  CHECK(b.stats["lightmap.inside"] == 0);
  CHECK(Light(b, "Glass").mesh.corners.size() == 72);
}

TEST_CASE("bake: what shines into a closed thing that it touches is no leak, and shines outwards only") {
  // The lower end of the cap lies in the upper end of the post.
  auto block = [](const char* name, double y, double half, const std::string& surface, const char* solid) {
    return "Transform { translation 0 " + std::to_string(y) + " 0 children DEF " + name + " Shape { " + surface +
           " geometry IndexedFaceSet { " + solid + " " + box(false, half).substr(17) + " } } ";
  };
  const std::string plate = "DEF Plate Transform { translation 0 -0.9 0 children Shape { " + material(0.5) +
                            " geometry Box { size 3 0.1 3 } } } ";
  Baked b(block("Post", 0, 1, material(0.5), "") + block("Cap", 2, 1, material(0, 1), "") + plate,
          "quality=draft,max-size=64");
  CHECK(b.stats["lightmap.inside"] > 0);
  CHECK(b.stats["lightmap.leaks"] == 0);
  // A closed lamp whose inner side is not visible, and something in it.
  Baked lamp(block("Lamp", 0, 1, material(0, 1), "solid FALSE") +
                 "DEF In Transform { scale 0.3 0.3 0.3 children DEF Core Shape { " + material(0.5) + " geometry " +
                 box(false, 1) + " } }",
             "quality=draft,max-size=64");
  Light core(lamp, "Core");
  for (std::size_t i = 0; i < core.mesh.corners.size() / 3; ++i) CHECK(core.at(i, 0.3, 0.3) == 0);
}

TEST_CASE("bake: a large face hides nothing from itself where it goes through the middle of the world", "[bake]") {
  Baked b("DEF Plate Shape { " + material(0.5) +
              " geometry IndexedFaceSet { coord Coordinate { point [ -1.1 -0.6 0.53, 1.1 -0.6 -0.53, 1.1 0.67 -0.53, "
              "-1.1 0.67 0.53 ] } "
              "coordIndex [ 0 1 2 3 -1 ] } } DirectionalLight { direction 0 0 -1 }",
          "quality=draft,max-size=128");
  Light plate(b, "Plate");
  for (double a = 0.01; a < 1; a += 0.02)
    for (double c = 0.01; a + c < 1; c += 0.02) CHECK(plate.at(std::size_t{0}, a, c) == Approx(0.901).epsilon(0.02));
}
