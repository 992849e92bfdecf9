// Long work that is to stop comes back within one unit of what it does: a tile of texels, a block of patches, a
// collapse.
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "base/parallel.h"
#include "base/stop.h"
#include "convert/wrlkit.h"
#include "geometry/simplify/collapse.h"
#include "light/patches/methods.h"
#include "passes/lod/lod.h"
#include "scenegraph/verify.h"

using namespace wrlkit;

namespace {

/// Stops the work at its nth step, and counts those behind it.
class StopsAt final : public Monitor {
 public:
  explicit StopsAt(int steps) : left_(steps) {}
  void begin(std::string, std::uint64_t, std::string unit) override { counts_ = unit == "tiles"; }
  void step(std::uint64_t) override {
    if (!counts_) return;
    n_behind_ += source_.stop_requested();
    if (--left_ == 0) source_.request_stop();
  }
  std::stop_token token() const { return source_.get_token(); }
  bool has_stopped() const { return source_.stop_requested(); }
  int n_behind() const { return n_behind_; }

 private:
  std::stop_source source_;
  bool counts_ = false;
  int left_, n_behind_ = 0;
};

/// A floor of n by n squares that waves.
std::string wavy_floor(int n) {
  std::string points, faces;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x)
      points += std::to_string(x) + " " + std::to_string(std::sin(x + 0.7 * y)) + " " + std::to_string(y) + ", ";
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + n + 1;
      for (int corner : {a, b, b + 1, a + 1, -1}) faces += std::to_string(corner) + " ";
    }
  return "#VRML V2.0 utf8\nPointLight { location 5 20 5 }\nShape { appearance Appearance { material Material { } } "
         "geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ " +
         points + " ] } coordIndex [ " + faces + " ] } }\n";
}

}  // namespace

TEST_CASE("stop: parallel loops end between two calls", "[stop]") {
  std::stop_source source;
  const std::stop_token token = source.get_token();
  for (int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    std::stop_source of_this;
    const std::stop_token asked = of_this.get_token();
    const StopScope scope(asked);
    std::atomic<int> calls = 0;
    const auto work = [&](std::size_t) {
      if (++calls == 10) of_this.request_stop();
    };
    CHECK_THROWS_AS(parallel_for(1'000'000, work), Stopped);
    CHECK(calls >= 10);
    CHECK(calls <= 10 + threads);
  }
  CHECK(StopScope::current() == nullptr);
  parallel_for(10, [](std::size_t) { check_stop(); });  // it cannot be stopped
}

TEST_CASE("stop: each way to illuminate ends within a round", "[stop]") {
  const auto document = load_bytes(wavy_floor(20), "floor.wrl");
  REQUIRE(document);
  Statistics counts;
  Diagnostics said;
  PassContext ctx(said, counts);
  std::string why;
  Scene scene = document.scene();
  auto pipeline = Pipeline::parse("tessellate", why);
  const light::LightWorld world(scene, pipeline->run_lazily(scene, ctx), nullptr, {}, said);
  const light::PatchedWorld patched(world, {.max_edge = 0.5}, said);
  for (const auto method :
       {light::Method::path, light::Method::stochastic_iteration, light::Method::progressive_radiosity}) {
    std::stop_source source;
    const std::stop_token token = source.get_token();
    const StopScope scope(token);
    int n_told = 0;
    const auto stop = [&](double) {
      ++n_told;
      source.request_stop();
    };
    INFO(name_of(method));
    CHECK_THROWS_AS(light::illuminate(patched, method, {.samples = 64, .done = stop}), Stopped);
    CHECK(n_told == 1);
  }
}

TEST_CASE("stop: a lightmap ends within a tile, and no file is there", "[stop]") {
  const auto path = (std::filesystem::temp_directory_path() / "wrlkit_stopped.glb").string();
  for (int steps : {1, 3}) {
    StopsAt watcher(steps);
    Document document = load_bytes(wavy_floor(8), "floor.wrl", {}, {&watcher, watcher.token()});
    const auto saved = save(std::move(document), path, {.pipeline = "lightmap{quality=draft,max-size=128}"});
    REQUIRE(watcher.has_stopped());
    CHECK(saved.ending == Ending::stopped);
    CHECK(watcher.n_behind() == 0);
    CHECK(!std::filesystem::exists(path));
  }
}

TEST_CASE("stop: a bake that is stopped leaves a valid scene", "[stop]") {
  StopsAt watcher(1);
  Document document = load_bytes(wavy_floor(8), "floor.wrl", {}, {&watcher, watcher.token()});
  CHECK(bake(document, {.quality = BakeQuality::draft, .max_size = 128}) == Ending::stopped);
  CHECK(watcher.n_behind() == 0);
  CHECK(document.resources()->made().empty());
  CHECK(verify(document.scene(), Level::expanded, document.diag()));
}

TEST_CASE("stop: simplification ends before the next collapse", "[stop]") {
  auto document = load_bytes(wavy_floor(40), "floor.wrl");
  REQUIRE(document);
  Scene scene = document.scene();
  const auto n_before = scene.node_count();
  std::stop_source source;
  source.request_stop();
  const std::stop_token token = source.get_token();
  const StopScope scope(token);
  CHECK_THROWS_AS(lod(scene, {}, document.context()), Stopped);
  CHECK(scene.node_count() == n_before);

  Mesh sheet;
  sheet.kind = Mesh::Kind::faces;
  auto& p = sheet.positions.edit();
  for (int i = 0; i < 30; ++i)
    for (int k = 0; k < 30; ++k)
      for (double v : {double(i), double(k), std::sin(i * k)}) p.push_back(v);
  for (std::uint32_t i = 0; i + 31 < 900; ++i)
    if (i % 30 < 29)
      for (std::uint32_t c : {i, i + 30, i + 1, i + 1, i + 30, i + 31}) sheet.corners.push_back(c);
  for (std::uint32_t c = 0; c <= sheet.corners.size(); c += 3) sheet.face_begin.push_back(c);
  const CollapseOptions options;
  Collapser collapser(sheet, options);
  const auto n_faces = collapser.n_faces();
  CHECK_THROWS_AS(collapser.run_to(100), Stopped);
  CHECK(collapser.n_faces() == n_faces);
}
