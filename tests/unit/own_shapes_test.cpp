// A Shape for each place where one is shown, and no more copies than that takes.
#include "passes/lightmap/own_shapes.h"

#include <catch2/catch.hpp>
#include <set>

#include "light/render/stage.h"
#include "parsers/parsers.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

using namespace wrlkit;

namespace {

struct TestWorld {
  Diagnostics diag;
  Scene scene;

  explicit TestWorld(const std::string& text) {
    auto world = parse_world("#VRML V2.0 utf8\n" + text, "test.wrl", {}, diag);
    REQUIRE(world);
    scene = std::move(world->scene);
  }
  std::multiset<std::string> names(TypeId type) const {
    std::multiset<std::string> out;
    for (NodeId n : reachable(scene, scene.main))
      if (scene.is(n, type)) out.emplace(scene.name(n));
    return out;
  }
  std::size_t count(TypeId type) const { return names(type).size(); }
};

}  // namespace

TEST_CASE("own shapes: each place has its own, and the geometry is shared") {
  TestWorld w(R"(DEF Bolt Transform { children DEF S Shape { geometry DEF G Box {} } }
             Transform { translation 3 0 0 children [ USE Bolt USE S ] })");
  auto places = drawing::set_stage(w.scene, w.diag).uses.size();
  CHECK(bake::own_shapes(w.scene, w.diag) == 3);
  CHECK(w.names(nodes::Shape) == std::multiset<std::string>{"S", "S_2", "S_3"});
  CHECK(w.names(nodes::Transform) == std::multiset<std::string>{"", "Bolt", "Bolt_2"});
  CHECK(w.count(nodes::Box) == 1);
  CHECK(drawing::set_stage(w.scene, w.diag).uses.size() == places);
  CHECK(bake::own_shapes(w.scene, w.diag) == 0);
}

TEST_CASE("own shapes: a copy of what has copies has copies of its own") {
  TestWorld w(R"(DEF A Transform { children [ DEF S Shape { geometry Box {} } USE S USE S ] }
                 Transform { children [ USE A USE A ] } Group { children USE A })");
  auto places = drawing::set_stage(w.scene, w.diag).uses.size();
  bake::own_shapes(w.scene, w.diag);
  CHECK(w.count(nodes::Shape) == places);
}

TEST_CASE("own shapes: a name that is taken is not given") {
  TestWorld w("DEF S Shape { geometry Box {} } DEF S_2 Group {} USE S");
  bake::own_shapes(w.scene, w.diag);
  CHECK(w.names(nodes::Shape) == std::multiset<std::string>{"S", "S_3"});
}

TEST_CASE("own shapes: what moves stays one node, and so does what holds it") {
  TestWorld w(R"(DEF Wheel Group { children DEF T Transform { children Shape { geometry Box {} } } }
             Transform { translation 3 0 0 children USE Wheel }
             DEF P PositionInterpolator {} ROUTE P.value_changed TO T.translation)");
  CHECK(bake::own_shapes(w.scene, w.diag) == 0);
  CHECK(w.count(nodes::Shape) == 1);
}

TEST_CASE("own shapes: what is not shown is not copied") {
  TestWorld w(R"(DEF S Shape { geometry Box {} }
             Switch { whichChoice 0 choice [ Group {} USE S ] }
             LOD { level [ Group {} USE S ] })");
  CHECK(bake::own_shapes(w.scene, w.diag) == 0);
  CHECK(bake::own_shapes(w.scene, w.diag, bake::OfLod::all) == 1);
}

TEST_CASE("own shapes: lights and empty groups stay shared") {
  TestWorld w("DEF L PointLight {} DEF E Group {} Transform { children [ USE L USE E ] }");
  CHECK(bake::own_shapes(w.scene, w.diag) == 0);
}

TEST_CASE("own shapes: a world that doubles itself ends at the limit, and says so") {
  std::string text = "DEF G0 Shape { geometry Box {} }\n";
  for (int i = 1; i <= 30; ++i)
    text += "DEF G" + std::to_string(i) + " Group { children [ USE G" + std::to_string(i - 1) + " USE G" +
            std::to_string(i - 1) + " ] }\n";
  TestWorld w(text);
  CHECK(bake::own_shapes(w.scene, w.diag, bake::OfLod::first, 1000) >= 1000);
  CHECK(w.diag.count(Severity::error) + w.diag.count(Severity::warning) > 0);
}
