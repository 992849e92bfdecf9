// By what factor light is shown.
#include "light/exposure.h"
#include "tests/unit/bake_fixture.h"

using namespace wrlkit;
using namespace wrlkit::bake_tests;

namespace {

std::vector<std::string> notes(const Baked& b) {
  const Scene& scene = b.world->scene;
  std::vector<std::string> out;
  for (NodeId n : all_nodes(scene))
    if (scene.is(n, nodes::WorldInfo))
      for (std::string_view line : scene.get(n, nodes::world_info::info)) out.emplace_back(line);
  return out;
}

const std::string open_floor = "DEF Floor Shape { " + material(0.5) + " geometry " + floor_of_4 + " } ";
const std::string draft = "quality=draft,max-size=64,";

}  // namespace

TEST_CASE("exposure: read and printed") {
  Exposure e;
  CHECK(e.read("auto"));
  CHECK(e.automatic);
  CHECK(e.print() == "auto");
  CHECK(e.read("2.5"));
  CHECK_FALSE(e.automatic);
  CHECK(e.print() == "2.5");
  for (const char* no : {"", "0", "-1", "2x", "inf", "nan", "bright"}) CHECK_FALSE(e.read(no));
}

TEST_CASE("exposure: the logarithmic mean, without what no light reaches") {
  light::LightMeter meter;
  CHECK(meter.factor(0.36) == 1);
  for (const double light : {0.01, 0.04, 0.0, 1e-7}) meter.add(light);
  CHECK(meter.factor(0.36) == Approx(18).epsilon(0.01));  // 0.02
  light::LightMeter spot;
  for (int i = 0; i < 1000; ++i) spot.add(i % 100 == 0 ? 0.5 : 0.001);
  CHECK(spot.factor(0.36) == Approx(8).epsilon(0.01));  // not 0.36 / 0.001
  light::LightMeter faint;
  faint.add(1e-9);
  CHECK(faint.factor(0.36) == 1e6);
}

TEST_CASE("exposure: found, said and kept", "[bake]") {
  const std::string sky = "sky=0.09:0.09:0.09";
  Baked as_it_is(open_floor, draft + sky), found(open_floor, draft + sky + ",exposure=auto");
  CHECK(Light(as_it_is, "Floor").on_floor(0.1, 0.1) == Approx(0.09).epsilon(0.03));
  CHECK(Light(found, "Floor").on_floor(0.1, 0.1) == Approx(0.36).epsilon(0.03));
  CHECK(as_it_is.diag.count(Diag::light_exposure) == 0);
  REQUIRE(found.diag.count(Diag::light_exposure) == 1);
  CHECK(notes(as_it_is).empty());
  const std::string factor = found.diag.messages()[0].args[0];
  CHECK(std::stod(factor) == Approx(4).epsilon(0.02));
  CHECK(notes(found) == std::vector<std::string>{"lightmap exposure " + factor});
  CHECK(double(found.stats["lightmap.exposure-thousandths"]) == Approx(4000).epsilon(0.02));

  Baked again("WorldInfo { title \"Hall\" info [ \"by me\", \"lightmap exposure 9\" ] } " + open_floor,
              draft + sky + ",exposure=" + factor);
  CHECK(Light(again, "Floor").on_floor(0.1, 0.1) == Light(found, "Floor").on_floor(0.1, 0.1));
  CHECK(again.diag.count(Diag::light_exposure) == 0);
  CHECK(notes(again) == std::vector<std::string>{"by me", "lightmap exposure " + factor});
}

TEST_CASE("exposure: one factor for all levels of detail; bright worlds become darker", "[bake]") {
  const std::string lamp = "PointLight { location 0 1 0 attenuation 0 0 0.001 } ";
  auto named = [](const std::string& name) {
    return "DEF " + name + " Shape { " + material(0.5) + " geometry " + floor_of_4 + " } ";
  };
  const std::string levels = "LOD { range 10 level [ " + named("Near") + named("Far") + " ] } " + lamp + lamp + lamp;
  Baked written(levels, "quality=draft,max-size=64"), b(levels, draft + "exposure=auto");
  const double factor = Light(b, "Near").on_floor(0.1, 0.1) / Light(written, "Near").on_floor(0.1, 0.1);
  CHECK(factor < 0.5);
  CHECK(Light(b, "Far").on_floor(0.1, 0.1) / Light(written, "Far").on_floor(0.1, 0.1) == Approx(factor).epsilon(0.03));
  CHECK(b.diag.count(Diag::light_exposure) == 1);
}

TEST_CASE("lamps: a bake lights beyond the radius", "[bake]") {
  const std::string world = "PointLight { location 0 1 0 radius 1.2 } " + open_floor;
  Baked written(world, "quality=draft,max-size=64"), spread(world, draft + "lamps=inverse-square");
  CHECK(Light(written, "Floor").on_floor(1.5, 0.01) == Approx(0).margin(1e-3));
  // As strong as written at 1.2: 1.44 cos / d^2, and cos is 1 / d.
  const double d = std::hypot(1.5, 1);
  CHECK(Light(spread, "Floor").on_floor(1.5, 0.01) == Approx(1.44 / (d * d * d)).epsilon(0.05));
}
