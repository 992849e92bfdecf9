// What Appearances say, and where Shapes stand: read once for all.
#include <catch2/catch.hpp>

#include <cmath>

#include "parsers/parsers.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/looks/texture_transform_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"

using namespace wrlkit;

namespace {

Scene scene_of(const std::string& text) {
  Diagnostics diag;
  auto world = parse_world("#X3D V4.0 utf8\nPROFILE Full\n" + text, "test.x3dv", {}, diag);
  REQUIRE(world);
  return std::move(world->scene);
}

std::optional<MaterialNode> material(const std::string& text) {
  const Scene s = scene_of("Shape { appearance Appearance { material " + text + " } }");
  return material_of(s, s.get(s.main.roots[0], nodes::shape::appearance));
}

std::string doubled(int times) {
  std::string text = "Shape { geometry Box { } }";
  for (int i = 0; i < times; ++i) {
    const std::string name = "G" + std::to_string(i);
    text = "Group { children [ DEF " + name + " Group { children " + text + " } USE " + name + " ] }";
  }
  return text;
}

}  // namespace

TEST_CASE("looks: a material, whichever of the three it is") {
  const auto phong = material("Material { diffuseColor 1 0 0 emissiveColor 0 1 0 transparency 0.25 }");
  REQUIRE(phong);
  CHECK(phong->kind == MaterialNode::Kind::phong);
  CHECK(phong->color == Vec3{1, 0, 0});
  CHECK(phong->emissive == Vec3{0, 1, 0});
  CHECK(phong->transparency == 0.25);
  CHECK_FALSE(phong->color_picture);
  const auto physical = material("PhysicalMaterial { baseColor 0 0 1 baseTexture PixelTexture { } }");
  REQUIRE(physical);
  CHECK(physical->color[0] == 0);
  CHECK(physical->color[2] == Approx(1));
  const auto linear = material("PhysicalMaterial { baseColor 0.21404114 0 0 emissiveColor 0 0.21404114 0 }");
  CHECK(linear->color[0] == Approx(0.5));
  CHECK(linear->emissive[1] == Approx(0.5));
  CHECK(physical->metallic == 1);
  CHECK(physical->color_picture);
  CHECK(physical->color_picture_slot == nodes::physical_material::baseTexture.slot);
  const auto unlit = material("UnlitMaterial { emissiveColor 1 0 1 emissiveTexture PixelTexture { } }");
  REQUIRE(unlit);
  CHECK(unlit->color == Vec3{1, 0, 1});
  CHECK(unlit->color_picture);
  CHECK_FALSE(unlit->emissive_picture);
  CHECK_FALSE(material("NULL"));
}

TEST_CASE("looks: a TextureTransform as a map, and back") {
  const TextureTransformNode node{{0, 0}, {2, -3}, {0.25, 0.5}, 0.3};
  const auto again = texture_transform_of(node.map());
  REQUIRE(again);
  for (const auto& [s, t] : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}}) {
    CHECK(again->map()(s, t)[0] == Approx(node.map()(s, t)[0]).margin(1e-11));
    CHECK(again->map()(s, t)[1] == Approx(node.map()(s, t)[1]).margin(1e-11));
  }
  CHECK(TextureTransformNode{{0.5, 0.5}, {2, 2}, {0, 0}, 0}.map()(0.5, 0.5) == Vec2{1.5, 1.5});
  CHECK_FALSE(texture_transform_of({1, 0.5, 0, 1, 0, 0}));  // sheared
  CHECK_FALSE(texture_transform_of({0, 0, 0, 1, 0, 0}));
  CHECK(TextureTransformNode{{0, 0}, {INFINITY, 1}, {0, 0}, 0}.map() == TexcoordMap{});
}

TEST_CASE("places: of every use, in the order of the file") {
  const Scene s = scene_of(
      "DEF T Transform { translation 1 0 0 children DEF S Shape { } } Transform { translation 0 5 0 children USE T }");
  std::vector<Vec3> at;
  CHECK(for_each_place(s, Shown::now, [&](NodeId, const Matrix& m) { at.push_back(m.point({0, 0, 0})); }));
  CHECK(at == std::vector<Vec3>{{1, 0, 0}, {1, 5, 0}});
}

TEST_CASE("places: more ways than can be followed are reported") {
  std::size_t n = 0;
  CHECK(for_each_place(scene_of(doubled(10)), Shown::now, [&](NodeId, const Matrix&) { ++n; }));
  CHECK(n == 1024);
  CHECK_FALSE(for_each_place(scene_of(doubled(24)), Shown::now, [](NodeId, const Matrix&) {}));
}
