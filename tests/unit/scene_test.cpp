// Scenes: typed access, copies that share arrays, import, equality.
#include <catch2/catch.hpp>

#include <memory>

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

TEST_CASE("scene: fields that are set one after another take one place each", "[scene]") {
  Scene scene;
  const NodeId a = scene.add(nodes::Material), b = scene.add(nodes::Material);
  namespace f = nodes::material;
  scene.set(a, f::transparency, 0.5);
  scene.set(a, f::shininess, 0.5);
  scene.set(a, f::ambientIntensity, 0.5);
  scene.set(b, f::transparency, 0.25);
  CHECK(scene.fields(a).size() == 3);
  CHECK(scene.fields(b).data() == scene.fields(a).data() + 3);
  scene.set(a, f::emissiveColor, Vec3{1, 0, 0});  // b's field is in the way
  CHECK(scene.fields(a).size() == 4);
  CHECK(scene.get(a, f::shininess) == 0.5);
  CHECK(scene.get(a, f::emissiveColor) == Vec3{1, 0, 0});
  CHECK(scene.get(b, f::transparency) == 0.25);
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

TEST_CASE("scene: a copy outlives its original with the types that the file declared", "[scene]") {
  auto original = std::make_unique<Scene>(scene_of("PROTO P [ field SFInt32 n 7 ] { Group { } } P { }"));
  const Scene copy = *original;
  original.reset();
  CHECK(copy.value(copy.main.roots[0], 0).integer == 7);
}

TEST_CASE("scene: nodes with many fields find them like others", "[scene]") {
  std::string declared, given;
  for (int i = 0; i < 100; ++i) {
    declared += "field SFInt32 f" + std::to_string(i) + " 0 ";
    given += "f" + std::to_string((i * 37) % 100) + ' ' + std::to_string(i) + " other" + std::to_string(i) + " 1 ";
  }
  Diagnostics diag;
  auto world = parse_world("#VRML V2.0 utf8\nPROTO P [ " + declared + "] { Group { } } P { " + given + "f37 1000 }",
                           "test.wrl", {}, diag);
  REQUIRE(world);
  auto& s = world->scene;
  NodeId p = s.main.roots[0];
  CHECK(diag.count(Diag::duplicate_field) == 1);
  CHECK(diag.count(Diag::unknown_field) == 100);
  CHECK(s.fields(p).size() == 200);
  for (int i = 0; i < 100; ++i) {
    auto slot = s.type(p).find("f" + std::to_string((i * 37) % 100), s.dialect());
    REQUIRE(slot);
    CHECK(s.value(p, *slot).integer == (i == 1 ? 1000 : i));
  }
  s.set(p, s.make(FieldType::SFInt32, 40, std::int32_t{5}));
  CHECK(s.value(p, 40).integer == 5);
  s.unset(p, 40);
  CHECK(s.find(p, 40) == nullptr);
  CHECK(s.value(p, 41).integer == 93);
  CHECK_FALSE(s.type(p).find("f100", s.dialect()));
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
  CHECK(difference(scene_of("Group { children [ DEF A Shape { } USE A ] }"),
                   scene_of("Group { children [ DEF A Shape { } Shape { } ] }")) != "");
  CHECK(difference(scene_of("Shape { geometry Box { size 2 2 2 } }"), scene_of("Shape { geometry Box { } }")) == "");
  CHECK(difference(scene_of("Shape { geometry Box { size 2 2 3 } }"), scene_of("Shape { geometry Box { } }")) ==
        "Box: field size");
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
  auto s = scene_of(
      "Switch { whichChoice 1 choice [ Group { } DEF Shown Group { } ] } LOD { level [ DEF Fine Group { } Group { } ] "
      "} Collision { proxy Group { } children DEF Seen Group { } }");
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

TEST_CASE("scene: a node may have more fields than 16 bits count", "[scene]") {
  Scene scene;
  const NodeId n = scene.add(nodes::Group);
  const std::vector<Value> fields(70'000, scene.make_extra("x", scene.make(FieldType::SFInt32, 0, 1)));
  scene.set_fields(n, fields);
  CHECK(scene.fields(n).size() == 70'000);
}
