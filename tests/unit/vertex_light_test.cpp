// Colours at the corners in place of pictures of light.
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;

namespace {

const std::string scene_with_shadow =
    "DirectionalLight { direction 0 -1 0 } "
    "DEF Floor Shape { " +
    material(0.5) + " geometry " + floor_of_4 +
    " } "
    "Transform { translation 0 1 0 scale 0.3 1 0.3 children DEF Plate Shape { " +
    material(0.5) + " geometry " + floor_of_4 + " } } ";

struct Looks {
  bool has_picture, has_colors, has_material;
};

Looks looks(const Baked& b, std::string_view name) {
  const Scene& s = b.world->scene;
  const NodeId shape = b.shape(name), appearance = s.get(shape, nodes::shape::appearance),
               geometry = s.get(shape, nodes::shape::geometry);
  return {bool(s.get(appearance, nodes::appearance::texture)), bool(s.get(geometry, nodes::indexed_face_set::color)),
          bool(s.get(appearance, nodes::appearance::material))};
}

/// The pass and what makes colours of its light.
std::string combined(std::string_view into) {
  return "quality=draft,max-size=64},combine-lightmap{into=" + std::string(into);
}

}  // namespace

TEST_CASE("combine-lightmap: evenly lit parts get colours at their corners, shadows stay pictures",
          "[combine][vertex]") {
  Baked b(scene_with_shadow, combined("auto"));
  const Looks plate = looks(b, "Plate"), floor = looks(b, "Floor");
  CHECK(plate.has_colors);
  CHECK_FALSE(plate.has_picture);
  CHECK_FALSE(plate.has_material);
  CHECK(floor.has_picture);
  CHECK_FALSE(floor.has_colors);
  CHECK(b.stats["combine-lightmap.vertex-shapes"] == 1);
}

TEST_CASE("combine-lightmap: the colour at the corners is that of the light", "[combine][vertex]") {
  Baked b(scene_with_shadow, combined("vertex"));
  CHECK(b.stats["combine-lightmap.vertex-shapes"] == 2);
  CHECK(b.stats["combine-lightmap.pages"] == 0);
  const Scene& s = b.world->scene;
  const NodeId geometry = s.get(b.shape("Plate"), nodes::shape::geometry);
  const auto colors = s.get(s.get(geometry, nodes::indexed_face_set::color), nodes::color::color);
  REQUIRE(colors.size() >= 12);
  // The sun falls perpendicularly: the plate shows its own colour. Its under side sees the floor only.
  const double above = *std::ranges::max_element(colors);
  CHECK(above == Approx(linear_to_srgb(0.5)).margin(0.004));
}

TEST_CASE("combine-lightmap: colours at the corners change no Shape that others share", "[combine][vertex]") {
  const std::string two = "DirectionalLight { direction 0 -1 0 } DEF Up Shape { " + material(0.5) + " geometry DEF G " +
                          floor_of_4 + " } Transform { translation 9 0 0 rotation 1 0 0 1 children DEF Askew Shape { " +
                          material(0.5) + " geometry USE G } }";
  Baked b(two, combined("vertex"));
  const Scene& s = b.world->scene;
  const auto brightest = [&](std::string_view name) {
    const NodeId geometry = s.get(b.shape(name), nodes::shape::geometry);
    const auto colors = s.get(s.get(geometry, nodes::indexed_face_set::color), nodes::color::color);
    return *std::ranges::max_element(colors);
  };
  CHECK(brightest("Up") == Approx(linear_to_srgb(0.5)).margin(0.004));
  CHECK(brightest("Askew") == Approx(linear_to_srgb(0.5 * std::cos(1))).margin(0.004));
}
