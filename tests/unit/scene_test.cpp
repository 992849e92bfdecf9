// Scenes: typed access, copies that share arrays, import, equality.
#include <catch2/catch.hpp>

#include "parsers/parsers.h"
#include "scenegraph/equal.h"
#include "scenegraph/nodes.h"
#include "scenegraph/transform.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"

using namespace wrlkit;

namespace {

Scene scene_of(std::string text) {
  Diagnostics diag;
  auto world = parse_world("#VRML V2.0 utf8\n" + text, "test.wrl", {}, diag);
  REQUIRE(world);
  return std::move(world->scene);
}

}  // namespace

TEST_CASE("scene: written fields and defaults", "[scene]") {
  auto s = scene_of("Shape { geometry Cone { height 3 } }");
  NodeId cone = s.get(s.main.roots[0], nodes::shape::geometry);
  CHECK(s.get(cone, nodes::cone::height) == 3);
  CHECK(s.get(cone, nodes::cone::bottomRadius) == 1);
  CHECK(s.fields(cone).size() == 1);
  s.set(cone, nodes::cone::side, false);
  CHECK_FALSE(s.get(cone, nodes::cone::side));
  s.unset(cone, nodes::cone::height.slot);
  CHECK(s.get(cone, nodes::cone::height) == 2);
}

TEST_CASE("scene: a copy shares its arrays and nothing else", "[scene]") {
  auto s = scene_of("Shape { geometry PointSet { coord DEF C Coordinate { point [ 1 2 3, 4 5 6 ] } } }");
  NodeId coord = all_nodes(s).back();
  Scene copy = s;
  CHECK(copy.get(coord, nodes::coordinate::point).data() == s.get(coord, nodes::coordinate::point).data());
  copy.set(coord, nodes::coordinate::point, std::vector<double>{7, 8, 9});
  CHECK(s.get(coord, nodes::coordinate::point).size() == 6);
  CHECK(copy.get(coord, nodes::coordinate::point).size() == 3);
  CHECK_FALSE(difference(s, copy).empty());
}

TEST_CASE("scene: import keeps names, sharing, prototypes and routes", "[scene]") {
  auto s = scene_of("DEF Own Group { }");
  const auto part = scene_of(
      "PROTO P [ field SFNode n DEF D Group { } ] { Group { children IS n } }\n"
      "Transform { children [ DEF A Shape { } USE A P { } ] }\n"
      "DEF T TimeSensor { } DEF I PositionInterpolator { } ROUTE T.fraction_changed TO I.set_fraction");
  auto scope = s.import(part);
  Scene alone = s;
  alone.main = scope;
  CHECK(difference(alone, part) == "");
}

TEST_CASE("scene: numbers keep what the file says", "[scene]") {
  auto s = scene_of("Viewpoint { position 5000000.123 0.1 1e-30 }");
  CHECK(s.get(s.main.roots[0], nodes::viewpoint::position) == Vec3{5000000.123, 0.1, 1e-30});
}

TEST_CASE("equality sees values, sharing and routes, but not defaults that are written out", "[scene]") {
  CHECK(difference(scene_of("Group { children [ DEF A Shape { } USE A ] }"), scene_of("Group { children [ DEF A Shape { } Shape { } ] }")) != "");
  CHECK(difference(scene_of("Shape { geometry Box { size 2 2 2 } }"), scene_of("Shape { geometry Box { } }")) == "");
  CHECK(difference(scene_of("Shape { geometry Box { size 2 2 3 } }"), scene_of("Shape { geometry Box { } }")) == "Box: field size");
}

TEST_CASE("transform: T C R SR S -SR -C", "[scene]") {
  auto s = scene_of("Transform { translation 1 2 3 center 1 0 0 rotation 0 0 1 1.5707963267948966 scale 2 1 1 }");
  auto p = local_matrix(s, s.main.roots[0]).point({2, 0, 0});
  // (2,0,0) - center = (1,0,0), scaled (2,0,0), turned (0,2,0), + center + translation
  CHECK(p[0] == Approx(2));
  CHECK(p[1] == Approx(4));
  CHECK(p[2] == Approx(3));
}

TEST_CASE("walk: what a browser would show", "[scene]") {
  auto s = scene_of("Switch { whichChoice 1 choice [ Group { } DEF Shown Group { } ] } LOD { level [ DEF Fine Group { } Group { } ] } Collision { proxy Group { } children DEF Seen Group { } }");
  auto name = [&](int root) { return s.name(shown_children(s, s.main.roots[static_cast<std::size_t>(root)]).at(0)); };
  CHECK(name(0) == "Shown");
  CHECK(name(1) == "Fine");
  CHECK(name(2) == "Seen");
  CHECK(shown_children(s, s.main.roots[2]).size() == 1);
}

TEST_CASE("verify: what a level promises", "[scene]") {
  Diagnostics diag;
  auto s = scene_of("PROTO P [ ] { Group { } } P { }");
  CHECK(verify(s, Level::authored, diag));
  CHECK_FALSE(verify(s, Level::expanded, diag));
  CHECK(diag.count(Diag::verify) == 1);
  auto box = scene_of("Shape { geometry Box { } }");
  CHECK(verify(box, Level::expanded, diag));
  CHECK_FALSE(verify(box, Level::mesh, diag));
}
