// The measure of light inside closed walls, where only surfaces give light: it finds a leak that is made on purpose,
// and none where light belongs. `seal` is given that a case with a slit is closed, so light that comes in through it is
// what a leak is.
#include <catch2/catch.hpp>

#include "parsers/parsers.h"
#include "passes/lightmap/bake.h"
#include "passes/lightmap/unlit_shapes.h"
#include "passes/pipeline/pipeline.h"

using namespace wrlkit;
using namespace wrlkit::bake;

namespace {

/// A case of 2 m whose wall towards x ends at `height`; a plate lies in it, and what shines, a square of `half` a side,
/// looks down from `lamp`.
std::string world_with(double height, const std::string& lamp, double half) {
  const auto h = std::to_string(height), s = std::to_string(half);
  return "#VRML V2.0 utf8\nShape { appearance Appearance { material Material { } } geometry IndexedFaceSet { coord "
         "Coordinate { point [ -1 -1 -1, 1 -1 -1, 1 1 -1, -1 1 -1, "
         "-1 -1 1, 1 -1 1, 1 1 1, -1 1 1, 1 " +
         h + " -1, 1 " + h +
         " 1 ] } coordIndex [ 0 3 2 1 -1 4 5 6 7 -1 0 1 5 4 -1 3 7 6 2 -1 0 4 7 3 -1 1 8 9 5 -1 ] } }\n"
         "Transform { translation 0 -0.8 0 children Shape { appearance Appearance { material Material { } } geometry "
         "Box { size 1.8 0.1 1.8 } } }\n"
         "Transform { translation " +
         lamp +
         " children Shape { appearance Appearance { material Material { diffuseColor 0 0 0 emissiveColor 1 1 1 } } "
         "geometry IndexedFaceSet { "
         "coord Coordinate { point [ -" +
         s + " 0 -" + s + ", " + s + " 0 -" + s + ", " + s + " 0 " + s + ", -" + s + " 0 " + s +
         " ] } coordIndex [ 0 1 2 3 -1 ] } } }";
}

Statistics figures_of(const std::string& text) {
  Diagnostics diag;
  Statistics stats, out;
  auto parsed = parse_world(text, "test.wrl", {}, diag);
  REQUIRE(parsed);
  std::string why;
  PassContext ctx{diag, stats, nullptr};
  auto pipeline = Pipeline::parse("picture", why);
  auto meshes = pipeline->run_lazily(parsed->scene, ctx);
  light::LightWorld world(parsed->scene, meshes, nullptr, {.sky = light::LightOptions::Sky::none}, diag);
  auto parts = find_parts(parsed->scene, world, UnlitShapes(parsed->scene, false), {.texcoords = true}, ctx);
  REQUIRE(parts.size() == 3);
  for (std::size_t i : {0u, 1u}) world.seal(parts[i].uses[0], false);
  unfold_parts(parts, world.stage());
  const Layout layout(parts, {.side = 128, .mips = 1});
  PassContext baking{diag, out, nullptr};
  bake::bake(parts, layout, world, {.samples = 1, .rays = 6, .integrator = {.rays = 6}}, baking);
  return out;
}

}  // namespace

TEST_CASE("leaks: light of a surface that shines outside of what counts as closed", "[bake]") {
  // A lamp as small as a point, 1.7 m next to the slit and 3 m up, casts a strip on the plate, 3.75 m below it: of
  // its 7.2 square metres, which are all that is inside.
  for (double height : {0.95, 0.9}) {
    const double strip = 1.7 * (3.75 / (3 - 1.0) - 3.75 / (3 - height)) * 1.8;
    const auto leaking = figures_of(world_with(height, "2.7 3 0", 0.02));
    const auto share =
        static_cast<double>(leaking.at("lightmap.leaks")) / static_cast<double>(leaking.at("lightmap.inside"));
    CHECK(share == Approx(strip / 7.2).margin(0.0015));
  }
}

TEST_CASE("leaks: none where what shines stands within, or lies in the wall, or is kept out", "[bake]") {
  for (const char* lamp : {"0 0.5 0", "0 1 0", "0 0.99999 0", "0 3 0"}) {
    INFO(lamp);
    const auto light = figures_of(world_with(1, lamp, 0.3));
    CHECK(light.at("lightmap.inside") > 3'500);  // all of the plate
    CHECK(light.at("lightmap.leaks") == 0);
  }
}
