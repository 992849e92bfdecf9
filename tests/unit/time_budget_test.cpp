// What a bake can do in a given time, and how far it is.
#include "passes/lightmap/time_budget.h"

#include <cmath>
#include <vector>

#include "passes/lightmap/bake_progress.h"
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;
using bake::BakeSize;

namespace {

/// A machine on which a bake takes `fixed` and then, at full scale, `texel` and `ray` for each ray: seconds.
struct Machine {
  double fixed, texel, ray;

  double seconds(const BakeSize& size) const { return fixed + size.scale * size.scale * (texel + ray * size.rays); }
};

struct Chosen {
  BakeSize size;
  double trials = 0;
};

Chosen choose(const Machine& machine, double seconds, bool any_scale = true) {
  Chosen out;
  out.size = bake::size_for_time(seconds, any_scale, [&](const BakeSize& size) {
    out.trials += machine.seconds(size);
    return machine.seconds(size);
  });
  return out;
}

/// What was begun, and how far it went.
struct Noted final : Monitor {
  std::vector<std::pair<std::string, std::uint64_t>> begun;
  std::uint64_t steps = 0;

  void begin(std::string what, std::uint64_t total, std::string) override {
    begun.emplace_back(std::move(what), total);
  }
  void step(std::uint64_t n) override { steps += n; }
};

}  // namespace

TEST_CASE("bake: a time budget is kept, and most of it is used", "[bake][budget]") {
  for (const Machine machine : {Machine{0.1, 20, 10}, Machine{2, 60, 3}, Machine{0.5, 5, 100}})
    for (const double seconds : {10.0, 30.0, 100.0, 1000.0}) {
      const Chosen c = choose(machine, seconds);
      const double all = machine.seconds(c.size) + c.trials;
      INFO(seconds << " s: scale " << c.size.scale << ", " << c.size.rays << " rays, " << all << " s");
      CHECK(all <= seconds);
      CHECK((all >= 0.5 * seconds || c.size.rays == 2048));
      CHECK(c.size.rays % 2 == 0);
    }
}

TEST_CASE("bake: more time is never a smaller bake", "[bake][budget]") {
  const Machine machine{0.2, 30, 8};
  double scale = 0;
  for (double seconds = 1; seconds < 2000; seconds *= 1.7) {
    const Chosen c = choose(machine, seconds);
    CHECK(c.size.scale >= scale);
    scale = c.size.scale;
  }
  CHECK(scale == 1);
}

TEST_CASE("bake: where nothing fits the time, the least is done", "[bake][budget]") {
  const Chosen c = choose({50, 30, 8}, 1);
  CHECK(c.size.rays == 2);
  CHECK(c.size.scale == 1.0 / 32);
  CHECK(choose({0, 30, 8}, 1, false).size.scale == 1);
}

TEST_CASE("bake: what a time budget has chosen gives the same bytes again", "[bake][budget]") {
  const std::string room =
      "PointLight { location 0 1 0 } DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 + " }";
  Baked timed(room, "budget=1s");
  const std::string start = "lightmap budget ";
  std::string same;
  for (const NodeId n : all_nodes(timed.world->scene))
    if (timed.world->scene.is(n, nodes::WorldInfo))
      same = timed.world->scene.get(n, nodes::world_info::info)[0].substr(start.size());
  Baked again(room, same);
  Light a(timed, "Floor"), b(again, "Floor");
  for (const double at : {0.2, 0.5, 0.7}) CHECK(a.at(at, at) == b.at(at, at));
  CHECK(timed.stats["lightmap.texels"] == again.stats["lightmap.texels"]);
  CHECK(timed.stats["lightmap.rays"] == again.stats["lightmap.rays"]);
}

TEST_CASE("bake: all views are one stretch of work", "[bake]") {
  Noted noted;
  bake::BakeProgress progress(&noted, 3, true);
  Monitor& monitor = *progress.monitor();
  for (std::size_t view = 0; view < 3; ++view) {
    progress.begin_view(view);
    monitor.begin("surfaces", 0, "");
    monitor.begin("lightmap", view ? 8 : 64, "tiles");
    for (int tile = 0; tile < (view ? 8 : 64); ++tile) monitor.step(1);
  }
  REQUIRE(noted.begun.size() == 2);  // before it is known how much there is, and then
  CHECK(noted.begun[1].second == 64 + 16 + 4);
  CHECK(noted.steps == 64 + 16 + 4);
}

TEST_CASE("bake: who does not watch is told nothing", "[bake]") {
  CHECK(bake::BakeProgress(nullptr, 1, true).monitor() == nullptr);
}
