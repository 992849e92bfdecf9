// The pass `lightmap` by kinds of Shapes: polygons, levels of detail, letters, instances, and how fine each is.
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;

TEST_CASE("bake: a polygon in one chart is a polygon again, and all levels of a LOD have light", "[bake]") {
  auto level = [&](const char* name, const std::string& geometry) {
    return "DEF " + std::string(name) + " Shape { appearance DEF A Appearance { material Material { } } geometry " +
           geometry + " } ";
  };
  Baked b("LOD { range 10 level [ " + level("Near", "DEF G " + floor_of_4) + "Group { children [ " +
              level("Far", "USE G") + " ] } ] } " +
              "DEF Else Transform { translation 9 0 0 children Shape { appearance USE A geometry Box { } } } "
              "PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  const Scene& scene = b.world->scene;
  auto geometry = [&](const char* name) { return scene.get(b.shape(name), nodes::shape::geometry); };
  CHECK(geometry("Near") != geometry("Far"));
  for (const char* name : {"Near", "Far"}) {
    CHECK(scene.get(geometry(name), nodes::indexed_face_set::coordIndex).size() == 5);
    CHECK(Light(b, name).on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
  }
  const auto lods = all_nodes(scene);
  const auto lod = std::ranges::find_if(lods, [&](NodeId n) { return scene.is(n, nodes::LOD); });
  REQUIRE(lod != lods.end());
  CHECK(scene.get(*lod, nodes::lod::children)[0] == b.shape("Near"));
}

namespace {

/// The floor at y = 0, as a Shape of a name.
std::string floor_named(const std::string& name) {
  return "DEF " + name + " Shape { " + material(0.5) + " geometry " + floor_of_4 + " } ";
}

std::size_t n_lit(Baked& b) {
  const auto all = all_nodes(b.world->scene);
  return static_cast<std::size_t>(std::ranges::count_if(all, [&](NodeId n) {
    if (!b.world->scene.is(n, nodes::Shape)) return false;
    const NodeId look = b.world->scene.get(n, nodes::shape::appearance);
    return look && b.world->scene.get(look, nodes::appearance::lightmap);
  }));
}

}  // namespace

TEST_CASE("bake: LODs within levels have light at all of theirs, whichever level they stand in", "[bake]") {
  const std::string inner = "Group { children LOD { range 1 level [ " + floor_named("C") + floor_named("D") +
                            "Group { children LOD { range 1 level [ " + floor_named("E") + floor_named("F") +
                            " ] } } ] } }";
  Baked b("LOD { range [ 10 20 ] level [ " + floor_named("A") + inner + floor_named("B") +
              " ] } PointLight { location 0 2 0 attenuation 0 0 1 }",
          "quality=draft,max-size=128");
  for (const char* name : {"A", "B", "C", "D", "E", "F"}) {
    INFO(name);
    CHECK(Light(b, name).on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
  }
  CHECK(n_lit(b) == 6);
  CHECK(b.stats["lightmap.shapes"] == 6);
}

TEST_CASE("bake: a simpler level looks as the first one, also where something hides it that does not hide the first",
          "[bake]") {
  const std::string worlds[] = {"", ",directional=true"};
  std::size_t n_inherited[2];
  for (int i = 0; i < 2; ++i) {
    Baked b("LOD { range 10 level [ " + floor_named("Near") + " Transform { translation 0 -0.1 0 children " +
                floor_named("Far") + " } ] } Transform { translation 0 -0.51 0 children Shape { " + material(0.5) +
                " geometry Box { size 6 1 6 } } } PointLight { location 0 2 0 attenuation 0 0 1 }",
            "quality=draft,max-size=128" + worlds[i]);
    n_inherited[i] = b.stats["lightmap.inherited"];
    CHECK(Light(b, "Near").on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
    if (i == 0) CHECK(Light(b, "Far").on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
  }
  CHECK(n_inherited[0] > 500);
  CHECK(n_inherited[1] == 0);
}

TEST_CASE(
    "bake: a LOD that is shown twice has light of its own in each place, at each level, and its levels in their order",
    "[bake]") {
  // The second place is 4 m below the lamp instead of 2 m.
  Baked b(
      "DEF L LOD { range 10 level [ " + floor_named("Near") + floor_named("Far") +
          " Group { children DEF M LOD { range 10 level [ " + floor_named("X") + floor_named("Y") +
          " ] } } ] } Transform { translation 9 -2 0 children USE L } Transform { translation 99 0 0 children USE M } "
          "PointLight { location 0 2 0 attenuation 0 0 1 radius 6 } PointLight { location 9 2 0 attenuation 0 0 1 "
          "radius 6 } PointLight { location 99 1 0 attenuation 0 0 1 radius 6 } ",
      "quality=draft,max-size=256");
  CHECK(b.stats["lightmap.shapes"] == 10);
  CHECK(n_lit(b) == 10);
  for (const char* name : {"Near", "Far"}) {
    INFO(name);
    CHECK(Light(b, name).on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
    CHECK(Light(b, name + std::string("_2")).on_floor(0.01, 0.01) == Approx(1. / 16).epsilon(0.05));
  }
  const Scene& scene = b.world->scene;
  const auto all = all_nodes(scene);
  for (NodeId n : all) {
    if (!scene.is(n, nodes::LOD)) continue;
    const auto levels = scene.get(n, nodes::lod::children);
    CHECK(scene.name(levels[0]).substr(0, 1) == (scene.name(n).substr(0, 1) == "L" ? "N" : "X"));
  }
}

TEST_CASE("bake: a shade that lets out more light at a further level does not change the light of the world",
          "[bake]") {
  // The lamp is in a closed box, and just below the plate that is its second level.
  const std::string box = "Shape { " + material(0.5) + " geometry Box { size 0.4 0.4 0.4 } } ",
                    plate = "DEF Plate Shape { " + material(0.5) + " geometry Box { size 0.4 0.01 0.4 } } ";
  Baked b("LOD { range 10 level [ " + floor_named("Near") + floor_named("Far") +
              " ] } LOD { range 10 level [ Transform { translation 0 2 0 children " + box +
              "} Transform { translation 0 2.1 0 children " + plate +
              " } ] } PointLight { location 0 2 0 attenuation 0 0 1 } DirectionalLight { direction 0 -1 0 intensity "
              "0.5 } DEF Far_away Transform { translation 0 -50 0 children " +
              box + "}",
          "quality=draft,max-size=256");
  const double sun = srgb_to_linear(0.5);
  for (const char* name : {"Near", "Far"}) {
    INFO(name);
    CHECK(Light(b, name).on_floor(1.5, 1.5) == Approx(sun).epsilon(0.06));
  }
  CHECK(n_lit(b) == 5);
  CHECK(b.stats["lightmap.pages"] == 3);
}

TEST_CASE("bake: levels that come to no end are lit as far as there is a view of them, which is said", "[bake]") {
  std::string levels;
  for (int i = 0; i < 66; ++i)
    levels += "DEF S" + std::to_string(i) + " Shape { " + material(0.5) + " geometry " + floor_of_4 + " } ";
  Baked b("LOD { level [ " + levels + " ] } PointLight { location 0 2 0 }", "quality=draft,max-size=64");
  CHECK(n_lit(b) == 64);
  CHECK(b.diag.count(Severity::error) == 1);
}

TEST_CASE("bake: letters have light, in one chart for each side, and text that events write stays text", "[bake]") {
  auto text = [](const std::string& name, const std::string& place, const std::string& style = "") {
    return "Transform { " + place + " children DEF " + name + " Shape { " + material(0.5) + " geometry DEF " + name +
           "_text Text { string [ \"II II\" \"II II\" ] fontStyle " + style +
           " FontStyle { size 2 justify [ \"MIDDLE\" \"MIDDLE\" ] } } } } ";
  };
  Baked b(text("Plain", "") + text("Mirrored", "translation 20 0 0 scale -1 1 1") +
              text("Routed", "translation 40 0 0") + text("Styled", "translation 60 0 0", "DEF Style") +
              text("Written", "translation 80 0 0") +
              "DEF S Script { field SFNode sign USE Written_text eventOut MFString s eventOut MFString t } ROUTE S.s "
              "TO Routed_text.set_string ROUTE S.t TO Style.set_justify "
              "DirectionalLight { direction 0 0 -1 } DirectionalLight { direction 0 0 1 color 0 0 1 }",
          "quality=draft,max-size=256");
  const Scene& scene = b.world->scene;
  for (const char* name : {"Routed", "Styled", "Written"}) {
    INFO(name);
    const NodeId shape = b.shape(name);
    CHECK(scene.is(scene.get(shape, nodes::shape::geometry), nodes::Text));
    CHECK(!scene.get(scene.get(shape, nodes::shape::appearance), nodes::appearance::lightmap));
  }
  for (const char* name : {"Plain", "Mirrored"}) {
    INFO(name);
    Light light(b, name);
    const std::size_t n = light.mesh.corners.size() / 3, in_front = n / 2;
    REQUIRE(n > 0);
    CHECK(!scene.is(scene.get(b.shape(name), nodes::shape::geometry), nodes::Text));
    for (std::size_t i = 0; i < n; ++i)
      CHECK(light.at(i, 0.3, 0.3) == Approx(i < in_front ? 1 : 0).margin(0.03));  // the light from behind has no green
  }
  CHECK(b.stats["lightmap.charts"] == 4);
}

TEST_CASE("bake: materials of X3D 4.0 take light, and those that are unlit give it", "[bake]") {
  const std::string lamp =
      "Transform { translation 0 1 0 rotation 1 0 0 3.14159265 children Shape { appearance Appearance { material "
      "UnlitMaterial { emissiveColor 1 0.5 1 } } geometry " +
      floor_of_4 + " } } ";
  Baked b(
      "DEF Floor Shape { appearance Appearance { material PhysicalMaterial { baseColor 0.5 0.5 0.5 metallic 1 } } "
      "geometry " +
          floor_of_4 + " } " + lamp,
      "quality=draft,max-size=128,sky=none", "#X3D V4.0 utf8\nPROFILE Full\n");
  // The form factor of a square of 4 m from a point 1 m below its middle.
  CHECK(Light(b, "Floor").on_floor(0.01, 0.01) == Approx(0.831 * srgb_to_linear(0.5)).epsilon(0.03));
  CHECK(b.stats["lightmap.shapes"] == 1);
}

TEST_CASE("bake: shared geometry has as many texels a metre in each of its sizes, and is shared where they are alike",
          "[bake]") {
  auto at = [](const std::string& name, const std::string& transform) {
    return "Transform { " + transform + " children DEF " + name + " Shape { appearance USE Paint geometry USE G } } ";
  };
  Baked b("DEF One Shape { appearance DEF Paint Appearance { material Material {} } geometry DEF G " + floor_of_4 +
              " } " + at("Large", "translation 0 20 0 scale 4 4 4") + at("Long", "translation 0 40 0 scale 1 1 9") +
              at("Flat", "translation 0 60 0 scale 1 0 1") +
              at("Turned", "translation 9 0 0 rotation 1 2 3 1 scale 1.01 1 1") +
              at("Mirrored", "translation 18 0 0 scale -1 1 1"),
          "density=4,quality=draft");
  auto density = [&](const char* name, double x, double z) {
    const Light l(b, name);
    for (std::size_t c = 0; c < l.mesh.corners.size(); c += 3)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t from = c + k, to = c + (k + 1) % 3;
        const double *p = &l.mesh.positions[3 * l.mesh.corners[from]], *q = &l.mesh.positions[3 * l.mesh.corners[to]];
        CHECK(l.texels(from, to) == Approx(4 * std::hypot(x * (p[0] - q[0]), z * (p[2] - q[2]))).epsilon(0.02));
      }
    return b.world->scene.get(b.shape(name), nodes::shape::geometry);
  };
  const NodeId one = density("One", 1, 1), large = density("Large", 4, 4), length = density("Long", 1, 9);
  CHECK((one != large && one != length && large != length));
  for (const char* alike : {"Turned", "Mirrored"}) CHECK(density(alike, 1, 1) == one);
  density("Flat", 1, 1);
}

TEST_CASE("bake: each of very many leaves has a texel, also of a tree that is shown twice", "[bake]") {
  std::string points, faces;
  for (int i = 0; i < 300; ++i) {
    const std::string x = std::to_string(i % 20), z = std::to_string(i / 20);
    points += x + " 0 " + z + ", " + x + ".1 0 " + z + ", " + x + " 0.1 " + z + ", ";
    for (int k = 0; k < 3; ++k) faces += std::to_string(3 * i + k) + " ";
    faces += "-1 ";
  }
  Baked b("DEF Tree Shape { " + material(0.5) + " geometry IndexedFaceSet { coord Coordinate { point [ " + points +
              " ] } coordIndex [ " + faces + " ] } } Transform { translation 50 0 0 children USE Tree }",
          "quality=draft,max-size=32,sky=1:1:1");
  const Light tree(b, "Tree");
  std::set<std::pair<float, float>> places;
  for (std::size_t c = 0; c < tree.mesh.corners.size(); c += 3) {
    const float* p = tree.mesh.lightcoord.at(tree.mesh.lightcoord.index[c]);
    places.emplace(p[0], p[1]);
  }
  CHECK(places.size() == 300);
}

TEST_CASE("bake: what has a name gets as many texels as it is said to", "[bake]") {
  const std::string two = "DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 +
                          " } DEF Signs Group { children Transform { translation 0 1 0 children DEF Board Shape { " +
                          material(0.5) + " geometry " + floor_of_4 + " } } }";
  auto sides = [&](const std::string& options) {
    Baked b(two, "quality=draft,max-size=128" + options);
    auto side = [&](std::string_view name) {
      const Light l(b, name);
      double low = 1, high = 0;
      for (std::size_t i = 0; i < l.mesh.lightcoord.values.size(); i += 2) {
        low = std::min(low, double{l.mesh.lightcoord.values[i]});
        high = std::max(high, double{l.mesh.lightcoord.values[i]});
      }
      return high - low;
    };
    return side("Board") / side("Floor");
  };
  CHECK(sides("") == Approx(1).epsilon(0.05));
  CHECK(sides(",densities=Board=0.25") == Approx(0.25).epsilon(0.05));
  CHECK(sides(",densities=Wall*=3:Sig*=0.5:Floor=1") == Approx(0.5).epsilon(0.05));
  // The boards share their geometry.
  Baked b(
      "DEF A Shape { appearance DEF Paint Appearance { material Material {} } geometry DEF G Box {} } Transform { "
      "translation 3 0 0 children DEF B Shape { appearance USE Paint geometry USE G } }",
      "quality=draft,max-size=128,densities=B=3");
  CHECK(Light(b, "B").texels(0, 1) == Approx(3 * Light(b, "A").texels(0, 1)).epsilon(0.05));
  NamedDensities d;
  for (const char* wrong : {"Floor", "=2", "Floor=x", "Floor=0", "Floor=1:Wall"}) CHECK(!d.read(wrong));
  REQUIRE(d.read("A*=2:B=0.5"));
  CHECK(d.print() == "A*=2:B=0.5");
}
