// Grouping nodes and transforms of VRML97 as nodes of glTF.
#include <catch2/catch.hpp>
#include <random>

#include "tests/unit/gltf_fixture.h"
#include "writers/gltf/transform.h"

using namespace wrlkit;
using namespace wrlkit::gltf_tests;
using namespace std::literals;

// -- hierarchy

TEST_CASE("Groups and Transforms are nodes in the order of the file, children before parents", "[gltf]") {
  auto g = convert("DEF A Group { children [ DEF B Transform { translation 1 2 3 scale 2 2 2 children " +
                   triangle("C") + " } DEF D Group {} ] } " + triangle("E"));
  CHECK(g.j["scenes"][0]["nodes"] == json({3, 4}));
  CHECK(g.node("A")["children"] == json({1, 2}));
  CHECK(g.node("B") == json({{"name", "B"}, {"translation", {1, 2, 3}}, {"scale", {2, 2, 2}}, {"children", {0}}}));
  CHECK(g.node("D") == json({{"name", "D"}}));
}

TEST_CASE("A lone Shape without a name is the mesh of its Transform", "[gltf]") {
  std::string shape = "Shape { geometry Box {} }";
  auto g = convert("DEF A Transform { translation 1 0 0 children " + shape + " } DEF B Group { children " + shape +
                   " } DEF C Transform { children [ " + shape + shape + " ] } DEF D Anchor { children " + shape + " }");
  CHECK(g.node("A")["translation"] == json({1, 0, 0}));
  CHECK(g.node("A").contains("mesh"));
  CHECK(g.node("B").contains("mesh"));
  CHECK(g.node("C")["children"].size() == 2);
  CHECK(g.node("D")["children"].size() == 1);
  CHECK(g.j["nodes"].size() == 7);
}

TEST_CASE("Each use of a node is a node of its own and shares the mesh", "[gltf]") {
  auto g = convert("DEF Part Transform { translation 0 1 0 children [ " + triangle("S") +
                   " ] } Transform { translation 5 0 0 children USE Part }");
  CHECK(g.j["meshes"].size() == 1);
  CHECK(g.j["nodes"].size() == 5);
  CHECK(g.j["nodes"][0] == g.j["nodes"][2]);
  CHECK(g.j["nodes"][0]["mesh"] == 0);
}

TEST_CASE("A geometry with two materials is two meshes with the same data", "[gltf]") {
  auto g = convert(triangle("A", with_material("diffuseColor 1 0 0")) + "DEF B Shape { " +
                   with_material("diffuseColor 0 1 0") +
                   " geometry DEF G IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 "
                   "2 -1] } } DEF C Shape { " +
                   with_material("diffuseColor 0 0 1") + " geometry USE G }");
  CHECK(g.j["meshes"].size() == 3);
  CHECK(g.primitive("B")["attributes"] == g.primitive("C")["attributes"]);
  CHECK(g.primitive("B")["material"] != g.primitive("C")["material"]);
  CHECK(g.mesh_of("B")["name"] == "G");
  // Equal numbers are stored once, whichever node they come from.
  CHECK(g.primitive("A")["attributes"] == g.primitive("B")["attributes"]);
  CHECK(g.j["accessors"].size() == 2);
}

TEST_CASE("Shared groups that stand for 2^40 nodes end at the limit, and the rest is kept", "[gltf]") {
  std::string text = "DEF G0 Group { children " + triangle("S") + "}\n";
  for (int i = 1; i <= 40; ++i)
    text += "DEF G" + std::to_string(i) + " Group { children [ USE G" + std::to_string(i - 1) + " USE G" +
            std::to_string(i - 1) + " ] }\n";
  auto g = convert(text + triangle("Last"), nullptr, {.max_nodes = 5000});
  REQUIRE(g.written);
  CHECK(g.diag.count(Diag::expansion_limit) == 1);
  CHECK(g.j["nodes"].size() >= 5000);
  CHECK(g.j["nodes"].size() < 5100);
  CHECK(g.node("Last").contains("mesh"));
}

TEST_CASE("Depth is no danger", "[gltf]") {
  Diagnostics diag;
  auto world = parse("", diag);
  NodeId n;
  for (int i = 0; i < 200'000; ++i) {
    NodeId parent = world->scene.add(nodes::Group);
    if (n) world->scene.set(parent, nodes::group::children, std::vector<NodeId>{n});
    n = parent;
  }
  world->scene.main.roots.push_back(n);
  TempFolder folder;
  CHECK(write(*world, {}, nullptr, folder / "deep.glb", diag));
}

TEST_CASE("Of a Switch the chosen child is shown and the others are kept", "[gltf]") {
  auto g = convert("DEF S Switch { whichChoice 1 choice [ Shape { geometry Box { size 1 2 3 } } " + triangle("T") +
                   " DEF H Group {} ] }");
  CHECK(g.node("S")["children"].size() == 1);
  CHECK(g.j["meshes"].size() == 1);
  CHECK(g.node("S")["extras"]["vrml97"] == json::parse(R"({"Switch": {"whichChoice": 1, "choice": [
    {"Shape": {"geometry": {"Box": {"size": [1, 2, 3]}}}}, {"Shape": {"USE": "T"}}, {"Group": {"DEF": "H"}}]}})"));
  CHECK(g.diag.count(Diag::no_gltf_choice) == 1);
  CHECK(convert("Switch { whichChoice 7 choice Group {} }").j["nodes"].size() == 1);
}

TEST_CASE("Of a LOD the first level is the child; MSFT_lod has the others", "[gltf]") {
  auto g = convert(
      "DEF L LOD { center 1 0 0 range [ 10, 40 ] level [ DEF A Shape { geometry Box { size 2 2 2 } } DEF B Shape { "
      "geometry Box {} } DEF C Group {} ] }");
  auto index = [&](std::string_view name) {
    for (std::size_t i = 0; i < g.j["nodes"].size(); ++i)
      if (g.j["nodes"][i].value("name", "") == name) return i;
    return std::size_t{99};
  };
  CHECK(g.node("L")["children"] == json({index("A")}));
  CHECK(g.node("A")["extensions"]["MSFT_lod"]["ids"] == json({index("B"), index("C")}));
  CHECK(g.node("L")["extras"]["vrml97"]["LOD"] == json::parse(R"({"center": [1, 0, 0], "range": [10, 40]})"));
  CHECK(g.j["extensionsUsed"] == json({"KHR_materials_unlit", "MSFT_lod"}));
  auto coverage = numbers(g.node("A")["extras"]["MSFT_screencoverage"]);
  REQUIRE(coverage.size() == 3);
  const double half = std::tan(0.785398 / 2);  // of the window's height, at distance 1
  CHECK(coverage[0] == Approx(std::sqrt(3.0) / (10 * half)));
  CHECK(coverage[1] == Approx(std::sqrt(3.0) / (40 * half)));
  CHECK(coverage[2] == 0);
}

TEST_CASE("Groups with a meaning say in extras which", "[gltf]") {
  auto g = convert(
      "DEF A Anchor { url [ \"x.html\", \"y.html\" ] description \"go\" children Shape { geometry Box {} } }"
      "DEF B Billboard { axisOfRotation 0 0 0 } DEF C Collision { collide FALSE proxy Shape { geometry Sphere {} } "
      "children " +
      triangle("T") +
      " }"
      "DEF D Group { bboxSize 1 2 3 }");
  auto extras = [&](std::string_view name) { return g.node(name)["extras"]["vrml97"]; };
  CHECK(extras("A") == json::parse(R"({"Anchor": {"url": ["x.html", "y.html"], "description": "go"}})"));
  CHECK(extras("B") == json::parse(R"({"Billboard": {"axisOfRotation": [0, 0, 0]}})"));
  CHECK(extras("C") ==
        json::parse(R"({"Collision": {"collide": false, "proxy": {"Shape": {"geometry": {"Sphere": {}}}}}})"));
  CHECK(extras("D") == json::parse(R"({"Group": {"bboxSize": [1, 2, 3]}})"));
  CHECK(g.node("C")["children"].size() == 1);
  CHECK(g.j["meshes"].size() == 2);
  CHECK(g.messages(Diag::no_gltf_node) == std::vector{"no counterpart in glTF, kept in extras: Anchor, Billboard"s});
}

// -- transforms

TEST_CASE("Rotations are unit quaternions, whatever the length of the axis", "[gltf]") {
  auto g = convert(
      "DEF A Transform { rotation 0 0 3 1.5707963267948966 } DEF B Transform { rotation 0 0 0 2 } DEF C Transform { "
      "rotation 0 1 0 0 }");
  auto q = numbers(g.node("A")["rotation"]);
  CHECK(q[2] == Approx(std::sqrt(0.5)));
  CHECK(q[3] == Approx(std::sqrt(0.5)));
  CHECK(std::hypot(q[0], q[1], std::hypot(q[2], q[3])) == Approx(1).epsilon(1e-15));
  CHECK_FALSE(g.node("B").contains("rotation"));
  CHECK_FALSE(g.node("C").contains("rotation"));
}

TEST_CASE("A center needs no second node and stays in extras", "[gltf]") {
  auto g = convert("DEF A Transform { center 1 0 0 rotation 0 0 1 1.5707963267948966 scale 2 2 2 }");
  auto t = numbers(g.node("A")["translation"]);
  CHECK(t[0] == Approx(1));
  CHECK(t[1] == Approx(-2));
  CHECK(g.j["nodes"].size() == 1);
  CHECK(g.node("A")["extras"]["vrml97"]["Transform"]["center"] == json({1, 0, 0}));
  CHECK(g.node("A")["extras"]["vrml97"]["Transform"]["scale"] == json({2, 2, 2}));
}

TEST_CASE("A scale along turned axes takes two nodes, unless the axes are only swapped", "[gltf]") {
  auto two = convert("DEF A Transform { scale 1 2 3 scaleOrientation 0 0 1 0.3 children " + triangle("T") + " }");
  CHECK(two.j["nodes"].size() == 3);
  CHECK(two.node("A")["scale"] == json({1, 2, 3}));
  auto one = convert("DEF A Transform { scale 1 2 3 scaleOrientation 0 0 1 1.5707963267948966 children " +
                     triangle("T") + " }");
  CHECK(one.j["nodes"].size() == 2);
  CHECK(numbers(one.node("A")["scale"])[0] == Approx(2));
  CHECK(numbers(one.node("A")["scale"])[1] == Approx(1));
}

TEST_CASE("Nodes of any Transform make the matrix of the standard", "[gltf]") {
  std::mt19937 random(7);
  auto number = [&] { return std::uniform_real_distribution<double>(-3, 3)(random); };
  auto some = [&](std::vector<double> v, int n) {
    for (int i = 0; i < n; ++i) v.push_back(number());
    return v;
  };
  Diagnostics diag;
  auto world = parse("", diag);
  Scene& s = world->scene;
  for (int i = 0; i < 200; ++i) {
    NodeId n = s.add(nodes::Transform);
    namespace f = nodes::transform;
    if (random() % 2) s.set(n, f::center, some({}, 3));
    if (random() % 2) s.set(n, f::translation, some({}, 3));
    if (random() % 2) s.set(n, f::rotation, some({}, 4));
    if (random() % 2) s.set(n, f::scaleOrientation, some({}, 4));
    if (random() % 2) s.set(n, f::scale, some({}, 3));
    auto t = gltf::node_transform(s, n);
    Matrix m = gltf::matrix(t.outer);
    if (t.inner) m = m * gltf::matrix(*t.inner);
    CHECK(difference(m, local_matrix(s, n)) < 1e-12);
  }
}

TEST_CASE("Numbers that are not finite read as the default", "[gltf]") {
  Diagnostics diag;
  auto world = parse("DEF A Transform {} DEF V Viewpoint {} DEF P PointLight {}", diag);
  Scene& s = world->scene;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  s.set(s.main.roots[0], nodes::transform::translation, Vec3{1, nan, 2});
  s.set(s.main.roots[0], nodes::transform::rotation, Vec4{inf, 0, 0, 1});
  s.set(s.main.roots[0], nodes::transform::scale, Vec3{inf, 1, 1});
  s.set(s.main.roots[1], nodes::viewpoint::position, Vec3{nan, 0, 5});
  s.set(s.main.roots[1], nodes::viewpoint::fieldOfView, nan);
  s.set(s.main.roots[2], nodes::point_light::location, Vec3{0, inf, 0});
  TempFolder folder;
  REQUIRE(write(*world, {.extras = false}, nullptr, folder / "n.glb", diag));
  auto bytes = folder.read("n.glb");
  auto j = json::parse(bytes.substr(20, word(bytes, 12)));
  CHECK(j["nodes"][0] == json({{"name", "A"}}));
  CHECK_FALSE(j["nodes"][1].contains("translation"));
  CHECK_FALSE(j["nodes"][2].contains("translation"));
  CHECK(j["cameras"][0]["perspective"]["yfov"].get<double>() == Approx(pi / 4));
}
