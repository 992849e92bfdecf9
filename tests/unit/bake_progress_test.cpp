// What is said of a bake while it goes on.
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;

namespace {

/// Stretches of work that are counted in tiles: how many there should be, and how many there were.
struct Tiles final : Monitor {
  std::vector<std::pair<std::uint64_t, std::uint64_t>> stretches;
  bool counts = false;

  void begin(std::string, std::uint64_t total, std::string unit) override {
    counts = unit == "tiles";
    if (counts) stretches.emplace_back(total, 0);
  }
  void step(std::uint64_t n) override {
    if (counts) stretches.back().second += n;
  }
};

}  // namespace

TEST_CASE("bake: all pages are one stretch of work, whose end is known", "[bake]") {
  std::string floors = "PointLight { location 0 3 0 } ";
  for (int i = 0; i < 6; ++i)
    floors += "Transform { translation " + std::to_string(5 * i) + " 0 0 children Shape { " + material(0.5) +
              " geometry " + floor_of_4 + " } } ";
  Diagnostics diag;
  Statistics stats;
  FileResources resources({.input = "test.wrl"}, [](const std::string&, Diagnostics&) { return nullptr; });
  Tiles tiles;
  PassContext ctx{diag, stats, &resources};
  ctx.monitor = &tiles;
  const auto world = parse_world("#VRML V2.0 utf8\n" + floors, "test.wrl", {}, diag);
  REQUIRE(world);
  std::string why;
  REQUIRE(Pipeline::parse("lightmap{quality=draft,density=12,max-size=64}", why)->run(world->scene, ctx));
  CHECK(stats["lightmap.pages"] > 1);
  REQUIRE(tiles.stretches.size() == 1);
  CHECK(tiles.stretches[0].first >= stats["lightmap.pages"]);
  CHECK(tiles.stretches[0].first == tiles.stretches[0].second);
}
