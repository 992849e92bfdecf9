// The pass `lightmap` and Shapes without a Material.
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;

namespace {

const std::string lamp = "PointLight { location 0 2 0 attenuation 0 0 1 } ";
const std::string red = "texture PixelTexture { image 1 1 3 0xFF0000 } ";

std::string floor_with(const std::string& name, const std::string& looks) {
  return "DEF " + name + " Shape { " + looks + " geometry " + floor_of_4 + " } ";
}

bool has_light(Baked& b, std::string_view name) {
  const NodeId look = b.world->scene.get(b.shape(name), nodes::shape::appearance);
  return look && b.world->scene.get(look, nodes::appearance::lightmap);
}

}  // namespace

TEST_CASE("bake: Shapes without a Material are surfaces where there are lamps", "[bake]") {
  const std::string shapes = floor_with("Bare", "") + "Transform { translation 9 0 0 children " +
                             floor_with("Picture", "appearance DEF Red Appearance { " + red + "}") +
                             " } Transform { translation 18 0 0 children " + floor_with("Again", "appearance USE Red") +
                             " } Billboard { axisOfRotation 0 0 0 children " +
                             floor_with("Display", "appearance USE Red") + " } ";
  const std::string options = "quality=draft,max-size=128";
  Baked lit(lamp + shapes, options);
  CHECK(Light(lit, "Bare").on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
  CHECK(has_light(lit, "Picture"));
  CHECK(has_light(lit, "Again"));
  CHECK_FALSE(has_light(lit, "Display"));
  CHECK(lit.stats["lightmap.shapes"] == 3);
  const Scene& scene = lit.world->scene;
  auto look = [&](const char* name) { return scene.get(lit.shape(name), nodes::shape::appearance); };
  CHECK(scene.get(look("Picture"), nodes::appearance::material));
  CHECK(scene.get(look("Picture"), nodes::appearance::texture));
  CHECK_FALSE(scene.get(look("Display"), nodes::appearance::material));
  CHECK(look("Display") != look("Picture"));
  REQUIRE(lit.diag.count(Diag::unlit_lit) == 1);
  CHECK(lit.diag.messages().back().args[0] == "3");

  Baked kept(lamp + shapes, options + ",unlit=keep");
  CHECK(kept.stats["lightmap.shapes"] == 0);
  CHECK(kept.diag.messages().empty());

  Baked dark(floor_with("Lit", material(0.5)) + shapes, options);
  CHECK(dark.stats["lightmap.shapes"] == 1);
  CHECK(dark.diag.count(Diag::unlit_kept) == 1);
}

TEST_CASE("bake: films, pictures that events change, and what follows the viewer stay as they are", "[bake]") {
  const std::string looks = "appearance Appearance { texture DEF T PixelTexture { image 1 1 3 0xFF0000 } }";
  Baked b(lamp + floor_with("Slides", looks) +
              floor_with("Film", "appearance Appearance { texture MovieTexture { } }") +
              "DEF P ProximitySensor { size 9 9 9 } DEF H Transform { children " + floor_with("Display", "") +
              " } DEF Show Script { eventOut SFImage picture url \"javascript:\" } ROUTE Show.picture TO T.set_image "
              "ROUTE P.position_changed TO H.set_translation",
          "quality=draft,max-size=128");
  CHECK(b.stats["lightmap.shapes"] == 0);
}

TEST_CASE("bake: all levels of detail without a Material get light", "[bake]") {
  Baked b("LOD { range 10 level [ " + floor_with("Near", "appearance DEF A Appearance { " + red + "}") +
              floor_with("Far", "appearance USE A") + " ] } " + lamp,
          "quality=draft,max-size=128");
  for (const char* name : {"Near", "Far"}) CHECK(Light(b, name).on_floor(0.01, 0.01) == Approx(0.25).epsilon(0.05));
  CHECK(b.diag.count(Diag::unlit_lit) == 1);
}
