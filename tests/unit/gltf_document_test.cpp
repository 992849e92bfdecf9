// Steps over the nodes of a glTF file, each alone, on documents made by hand.
#include <catch2/catch.hpp>
#include <cmath>

#include "writers/gltf/document/dequantize.h"
#include "writers/gltf/document/levels.h"
#include "writers/gltf/document/move_to_origin.h"
#include "writers/gltf/document/round_transforms.h"

using namespace wrlkit;
using namespace wrlkit::gltf;

namespace {

/// A group without a transform that holds two meshes, the second one placed.
Document two_meshes() {
  Document d;
  const auto a = d.add({.attached = 0, .attachment = Attachment::mesh});
  const auto b = d.add({.transform = d.add_transform({{1.23456789, 0, 0}, {}, {2, 2, 2}}),
                        .attached = 1,
                        .attachment = Attachment::mesh});
  d.roots = {d.add({}, std::vector{a, b})};
  return d;
}

}  // namespace

TEST_CASE("gltf document: every node has its parent before it, and levels of detail have the parent of the first") {
  Document d = two_meshes();
  const auto level = d.add({});
  make_levels(d, std::vector<std::uint32_t>{1, level}, std::vector<double>{10}, 1, 1);
  const Family f = family_of(d);
  CHECK(f.order == std::vector<std::uint32_t>{2, 0, 1, 3});
  CHECK(f.parent == std::vector<std::uint32_t>{2, 2, none, 2});
  CHECK(d.lods.at(1).coverage.back() == 0);
}

TEST_CASE("gltf document: lengths grow by the transforms on the way") {
  Document d = two_meshes();
  d.nodes[2].transform = d.add_transform({{}, {}, {1, -3, 1}});
  CHECK(growth_of(d, family_of(d)) == std::vector<double>{3, 3, 1});
}

TEST_CASE("gltf document: what is far away is moved by the outermost translations") {
  Document d = two_meshes();
  move_to_origin(d);
  CHECK_FALSE(d.origin);
  d.world = {{5e6, 0, 0}, {5e6 + 10, 1, 1}};
  move_to_origin(d);
  REQUIRE(d.origin);
  CHECK(d.nodes[2].transform == none);
  CHECK(d.place(d.nodes[0]).translation[0] == -(*d.origin)[0]);
  CHECK(d.place(d.nodes[1]).translation[0] == 1.23456789 - (*d.origin)[0]);
}

TEST_CASE("gltf document: what is far away below units and axes is moved there") {
  Document d = two_meshes();
  d.transforms[d.nodes[1].transform].translation = {5e9, 0, 1000};
  d.nodes[0].transform = d.add_transform({{5e9 + 3000, 0, 0}, {}, {1, 1, 1}});
  d.nodes[2].transform = d.add_transform({{}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}, {0.001, 0.001, 0.001}});
  d.world = {{0, 5e6, 0}, {1, 5e6 + 10, 1}};
  move_to_origin(d);
  REQUIRE(d.origin);
  CHECK(d.place(d.nodes[2]).translation == Vec3{0, 0, 0});
  for (const auto child : {0, 1})
    for (const double v : d.place(d.nodes[child]).translation) CHECK(std::abs(v) < 1e6);
  CHECK(d.place(d.nodes[0]).translation[0] - d.place(d.nodes[1]).translation[0] == Approx(3000));
}

TEST_CASE("gltf document: scenes are moved to the origin that is given, or stay where they are") {
  Document d = two_meshes();
  d.world = {{5e6, 0, 0}, {5e6 + 10, 1, 1}};
  move_to_origin(d, {GltfOrigin::Kind::none, {}});
  CHECK_FALSE(d.origin);
  GltfOrigin origin;
  CHECK_FALSE(origin.read("1,2"));
  CHECK_FALSE(origin.read("1,2,3,4"));
  CHECK_FALSE(origin.read("1,2,inf"));
  CHECK_FALSE(origin.read("far"));
  REQUIRE(origin.read("1.25,-2,3e2"));
  CHECK(origin.print() == "1.25,-2,300");
  move_to_origin(d, origin);
  REQUIRE(d.origin);
  CHECK(*d.origin == Vec3{1.25, -2, 300});
  CHECK(d.place(d.nodes[0]).translation == Vec3{-1.25, 2, -300});
}

TEST_CASE("gltf document: transforms have the digits that a tolerance asks for, and stay when they move") {
  Document d = two_meshes();
  auto reach = [](std::uint32_t) { return 1.0; };
  const double moved = round_transforms(d, {1e-3, reach});
  CHECK(moved <= 1e-3);
  CHECK(moved > 0);
  CHECK(d.transforms[0].translation[0] == Approx(1.235).margin(1e-9));
  Document animated = two_meshes();
  CHECK(round_transforms(animated, {1e-3, reach, [](NodeId) { return true; }}) == 0);
  CHECK(animated.transforms[0].translation[0] == 1.23456789);
}

TEST_CASE("gltf document: the scale of whole numbers is in the node of the mesh, or in a child") {
  const Dequantization grid{{1, 0, 0}, 0.5};
  auto of_mesh = [&](std::uint32_t mesh) { return mesh == 1 ? &grid : nullptr; };
  Document d = two_meshes();
  dequantize(d, of_mesh, [](const Node&) { return false; });
  CHECK(d.nodes.size() == 3);
  CHECK(d.place(d.nodes[1]).scale == Vec3{1, 1, 1});
  CHECK(d.place(d.nodes[1]).translation[0] == Approx(3.23456789));
  Document kept = two_meshes();
  dequantize(kept, of_mesh, [](const Node&) { return true; });
  REQUIRE(kept.nodes.size() == 4);
  CHECK(kept.nodes[1].attachment == Attachment::nothing);
  CHECK(kept.children_of(kept.nodes[1]).front() == 3);
  CHECK(kept.place(kept.nodes[3]).scale == Vec3{0.5, 0.5, 0.5});
}

TEST_CASE("gltf document: rows go, the others move up") {
  Document d = two_meshes();
  d.nodes[2].n_children = 1;
  d.children[0] = 1;
  const std::vector<Mark> marks{Mark::row, Mark::nothing, Mark::referred};
  CHECK(remove_rows(d, marks) == std::vector<std::uint32_t>{none, 0, 1});
  CHECK(d.roots == std::vector<std::uint32_t>{1});
  CHECK(d.children_of(d.nodes[1]).front() == 0);
}
