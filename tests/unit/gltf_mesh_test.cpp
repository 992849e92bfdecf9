// Geometry of VRML97 as meshes of glTF: attributes, indices, colours, large coordinates.
#include <catch2/catch.hpp>

#include "tests/unit/gltf_fixture.h"
#include "writers/gltf/origin.h"
#include "writers/gltf/store.h"

using namespace wrlkit;
using namespace wrlkit::gltf_tests;
using namespace std::literals;

// -- geometry

TEST_CASE("Positions, normals and indices are the numbers of the file", "[gltf]") {
  auto g = convert(
      "DEF T Shape { geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 1 1 0, 0.1 1.25 0] } coordIndex "
      "[0 1 2 3 -1] } }");
  CHECK(g.attribute("T", "POSITION", 3) == std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0.1f, 1.25f, 0});
  CHECK(g.attribute("T", "NORMAL", 3) == std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  CHECK(g.corners("T").size() == 6);
  auto p = g.primitive("T");
  CHECK_FALSE(p.contains("mode"));
  const auto& a = g.j["accessors"][p["attributes"]["POSITION"].get<std::size_t>()];
  CHECK(a["min"] == json({0, 0, 0}));
  CHECK(a["max"] == json({1, 1.25, 0}));
  CHECK(a["type"] == "VEC3");
  CHECK(a["componentType"] == 5126);
  CHECK(g.view(p["attributes"]["POSITION"])["target"] == 34962);
  CHECK(g.view(p["attributes"]["POSITION"])["byteStride"] == 12);
  CHECK(g.view(p["indices"])["target"] == 34963);
  CHECK_FALSE(g.view(p["indices"]).contains("byteStride"));
}

TEST_CASE("Bounds are those of the floats that are stored", "[gltf]") {
  auto g = convert(
      "DEF T Shape { geometry PointSet { coord Coordinate { point [0.1 -0.2 3.4028234e38, 0.3 16777217 -7] } } }");
  auto p = g.attribute("T", "POSITION", 3);
  const auto& a = g.j["accessors"][g.primitive("T")["attributes"]["POSITION"].get<std::size_t>()];
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(static_cast<float>(a["min"][i].get<double>()) == std::min(p[i], p[3 + i]));
    CHECK(static_cast<float>(a["max"][i].get<double>()) == std::max(p[i], p[3 + i]));
  }
}

TEST_CASE("Corners that count up need no indices", "[gltf]") {
  auto g = convert(triangle("T"));
  CHECK_FALSE(g.primitive("T").contains("indices"));
  CHECK(g.corners("T").size() == 3);
}

TEST_CASE("solid is doubleSided and ccw is the order of the corners", "[gltf]") {
  auto g = convert(triangle("A") + triangle("B", "", "solid FALSE") + triangle("C", "", "ccw FALSE"));
  CHECK_FALSE(g.material("A").contains("doubleSided"));
  CHECK(g.material("B")["doubleSided"] == true);
  CHECK(g.corners("A") == std::vector<std::array<float, 3>>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  CHECK(g.corners("C") == std::vector<std::array<float, 3>>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  CHECK(g.attribute("C", "NORMAL", 3)[2] == -1);
}

TEST_CASE("A mirroring scale stays on the node: viewers turn the faces", "[gltf]") {
  auto g = convert("DEF M Transform { scale -1 1 1 children " + triangle("T") + " }" + triangle("U"));
  CHECK(g.node("M")["scale"] == json({-1, 1, 1}));
  CHECK(g.primitive("T") == g.primitive("U"));
}

TEST_CASE("Indices have 16 bits up to 65535 vertices", "[gltf]") {
  gltf::Store store;
  auto index = [&](std::uint32_t n) {
    std::vector<std::uint32_t> v{n - 1, 0, 1};
    return store.accessors()[store.indices(v, n)].view;
  };
  CHECK(index(3) == gltf::View::index16);
  CHECK(index(65535) == gltf::View::index16);
  CHECK(index(65536) == gltf::View::index32);
}

TEST_CASE("The store keeps equal data once, and tells apart what has equal hashes", "[gltf]") {
  gltf::Store store;
  std::vector<std::uint32_t> ids;
  for (float i = 0; i < 5000; ++i) ids.push_back(store.vertices(gltf::View::normal, std::array{i, 0.f, 0.f}));
  for (std::uint32_t i = 0; i < 5000; ++i) {
    CHECK(ids[i] == i);
    CHECK(store.vertices(gltf::View::normal, std::array{static_cast<float>(i), 0.f, 0.f}) == i);
  }
  CHECK(store.vertices(gltf::View::rgb, std::array{1.f, 0.f, 0.f}) == 5000);
  CHECK(store.bytes() == 5001 * 12);
}

TEST_CASE("Lines and points are unlit, of emissiveColor or Color", "[gltf]") {
  std::string coord = "coord Coordinate { point [0 0 0, 1 0 0, 1 1 0] }";
  auto g = convert("DEF L Shape { " + with_material("emissiveColor 0.5 0 1 diffuseColor 1 1 1") +
                   " geometry IndexedLineSet { " + coord +
                   " coordIndex [0 1 2 -1] } }"
                   "DEF P Shape { " +
                   with_material("emissiveColor 1 0 0") + " geometry PointSet { " + coord +
                   " color Color { color [1 0 0, 0 1 0, 0 0 0.5] } } }"
                   "DEF N Shape { geometry PointSet { " +
                   coord + " } }");
  CHECK(g.primitive("L")["mode"] == 1);
  CHECK(g.corners("L").size() == 4);
  CHECK_FALSE(g.primitive("L")["attributes"].contains("NORMAL"));
  auto m = g.material("L");
  CHECK(m["extensions"].contains("KHR_materials_unlit"));
  CHECK(m["pbrMetallicRoughness"]["baseColorFactor"][0].get<float>() == linear(0.5));
  CHECK(m["pbrMetallicRoughness"]["baseColorFactor"][2] == 1);
  CHECK_FALSE(m.contains("emissiveFactor"));

  CHECK(g.primitive("P")["mode"] == 0);
  CHECK(g.attribute("P", "COLOR_0", 3) == std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, linear(0.5)});
  CHECK_FALSE(g.material("P")["pbrMetallicRoughness"].contains("baseColorFactor"));
  CHECK_FALSE(g.material("N")["pbrMetallicRoughness"].contains("baseColorFactor"));
}

TEST_CASE("Colours of vertices and faces, in all four bindings", "[gltf]") {
  std::string faces = "coord Coordinate { point [0 0 0, 1 0 0, 0 1 0, 1 1 0] } coordIndex [0 1 2 -1 1 3 2 -1] ";
  auto shape = [&](std::string_view name, std::string_view fields) {
    return "DEF " + std::string(name) + " Shape { " + with_material("diffuseColor 0 0 0") +
           " geometry IndexedFaceSet { " + faces + std::string(fields) + " } }";
  };
  auto g = convert(shape("A", "color Color { color [1 0 0, 0 1 0, 0 0 1, 1 1 1] }") +
                   shape("B", "color Color { color [1 0 0, 0 1 0] } colorIndex [0 0 0 -1 1 1 1 -1]") +
                   shape("C", "colorPerVertex FALSE color Color { color [1 0 0, 0 1 0] }") +
                   shape("D", "colorPerVertex FALSE color Color { color [0 1 0, 1 0 0] } colorIndex [1 0]"));
  auto corner_colors = [&](std::string_view name) {
    auto c = g.attribute(name, "COLOR_0", 3);
    auto index = g.values<std::uint16_t>(g.primitive(name)["indices"], 1);
    std::string out;
    for (auto i : index)
      out += c[3 * i] == 1 && c[3 * i + 1] == 1 ? 'w' : c[3 * i] == 1 ? 'r' : c[3 * i + 1] == 1 ? 'g' : 'b';
    return out;
  };
  CHECK(corner_colors("A") == "rgbgwb");
  // A vertex for each corner of the faces that differ.
  CHECK(g.attribute("B", "COLOR_0", 3) == std::vector<float>{1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0});
  CHECK(g.attribute("C", "COLOR_0", 3) == g.attribute("B", "COLOR_0", 3));
  CHECK(g.attribute("D", "COLOR_0", 3) == g.attribute("B", "COLOR_0", 3));
  // Color takes the place of diffuseColor.
  CHECK_FALSE(g.material("A")["pbrMetallicRoughness"].contains("baseColorFactor"));
}

TEST_CASE("Forms keep their numbers", "[gltf]") {
  auto g = convert(
      "DEF C Shape { geometry Cylinder { radius 2 top FALSE } } DEF T Shape { geometry Text { string [ \"P-101\" ] } "
      "}");
  CHECK(g.mesh_of("C")["extras"]["vrml97"] == json::parse(R"({"Cylinder": {"radius": 2, "top": false}})"));
  CHECK(g.mesh_of("T")["extras"]["vrml97"] == json::parse(R"({"Text": {"string": ["P-101"]}})"));
}

TEST_CASE("Texture coordinates are there for pictures, or when the file gives them", "[gltf]") {
  Files files;
  files.files["a.png"] = png(3, {1, 2, 3});
  std::string given = "texCoord TextureCoordinate { point [0 0, 1 0, 0.25 1] }";
  auto g = convert("DEF A Shape { geometry DEF B Box {} } DEF C Shape { " + with_picture("a.png") +
                       " geometry USE B }" + triangle("D", "", given),
                   &files);
  CHECK_FALSE(g.primitive("A")["attributes"].contains("TEXCOORD_0"));
  CHECK(g.primitive("C")["attributes"].contains("TEXCOORD_0"));
  CHECK(g.primitive("A")["attributes"]["POSITION"] == g.primitive("C")["attributes"]["POSITION"]);
  // V counts from the top in glTF.
  CHECK(g.attribute("D", "TEXCOORD_0", 2) == std::vector<float>{0, 1, 1, 1, 0.25f, 0});
}

// -- large coordinates

TEST_CASE("A mesh far from its origin gets a translation of its own", "[gltf]") {
  auto g =
      convert("DEF T Shape { geometry PointSet { coord Coordinate { point [5000.125 0 0, 5001.375 0.5 0.25] } } } " +
              triangle("Near"));
  auto t = numbers(g.node("T")["translation"]);
  auto p = g.attribute("T", "POSITION", 3);
  CHECK(t[0] + p[0] == 5000.125);
  CHECK(t[0] + p[3] == 5001.375);
  CHECK(std::abs(p[0]) < 2);
  CHECK_FALSE(g.j["scenes"][0].contains("extras"));
  CHECK(g.attribute("Near", "POSITION", 3)[3] == 1);
}

TEST_CASE("A world far away is moved to the origin, which is kept", "[gltf]") {
  auto g = convert("DEF P Transform { translation 4500000.5 300000 12 children [ " + triangle("T") +
                   " Viewpoint { position 0 0 9 } ] }"
                   "DEF G Group { children DEF Q Shape { geometry PointSet { coord Coordinate { point [4500007.25 "
                   "300001 12, 4500008 300002 12.5] } } } }");
  auto o = numbers(g.j["scenes"][0]["extras"]["vrml97"]["origin"]);
  CHECK(std::abs(o[0] - 4500004) < 10);
  auto p = numbers(g.node("P")["translation"]);
  CHECK(p[0] + o[0] == 4500000.5);
  CHECK(std::abs(p[0]) < 20);
  CHECK_FALSE(g.node("G").contains("translation"));
  auto q = numbers(g.node("Q")["translation"]);
  CHECK(q[0] + g.attribute("Q", "POSITION", 3)[0] + o[0] == 4500007.25);
  // The light of the camera's clipping planes: relative, so unchanged.
  CHECK(g.j["cameras"][0]["perspective"]["zfar"].get<double>() < 100);
}

TEST_CASE("Ordinary plant coordinates stay what they are", "[gltf]") {
  Box plant{{2400, 0, 3900}, {2600, 40, 4100}}, bolt{{2500.00, 10, 4000}, {2500.02, 10.02, 4000.02}};
  CHECK_FALSE(gltf::world_origin(plant));
  CHECK_FALSE(gltf::world_origin(bolt));
  CHECK_FALSE(gltf::mesh_origin(plant));
  CHECK(gltf::mesh_origin(bolt));
  Box millimetres{{0, 0, 0}, {30000, 20000, 5000}};
  CHECK_FALSE(gltf::world_origin(millimetres));
  Box grid{{4500000, 300000, 0}, {4500200, 300200, 40}};
  REQUIRE(gltf::world_origin(grid));
  CHECK(*gltf::world_origin(grid) == Vec3{4500224, 300032, 0});  // multiples of 256, the power of two below its extent
}
