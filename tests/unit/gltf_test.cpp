// The files that the glTF writer makes: chunks, names, pictures next to them; and what is kept in extras.
#include <catch2/catch.hpp>

#include "tests/unit/gltf_fixture.h"

using namespace wrlkit;
using namespace wrlkit::gltf_tests;
using namespace std::literals;

// -- the file

TEST_CASE("A GLB has its two chunks at multiples of four bytes", "[gltf]") {
  auto g = convert(triangle("T"));
  REQUIRE(g.written);
  CHECK(g.bytes.substr(0, 4) == "glTF");
  CHECK(word(g.bytes, 4) == 2);
  CHECK(word(g.bytes, 8) == g.bytes.size());
  auto n = word(g.bytes, 12);
  CHECK(n % 4 == 0);
  CHECK(g.bytes.substr(16, 4) == "JSON");
  CHECK(word(g.bytes, 20 + n) == g.bin.size());
  CHECK(g.bytes.substr(24 + n, 4) == "BIN\0"s);
  CHECK(g.bin.size() % 4 == 0);
  CHECK(g.j["buffers"] == json::array({{{"byteLength", g.bin.size()}}}));
  CHECK(g.j["asset"]["version"] == "2.0");
}

TEST_CASE("A world without anything to draw is a file without a binary part", "[gltf]") {
  auto g = convert("");
  REQUIRE(g.written);
  CHECK(g.j["scenes"] == json::array({json::object()}));
  for (auto key : {"nodes", "meshes", "materials", "accessors", "bufferViews", "buffers", "extensionsUsed"})
    CHECK_FALSE(g.j.contains(key));
  CHECK(g.bin.empty());
  CHECK(g.bytes.size() == 20 + word(g.bytes, 12));
}

TEST_CASE("The same world gives the same bytes", "[gltf]") {
  auto text = triangle("A") + "Transform { children [" + triangle("B", with_material("diffuseColor 1 0 0")) +
              " Viewpoint {} PointLight {} ] }";
  CHECK(convert(text).bytes == convert(text).bytes);
}

TEST_CASE("A .gltf has its binary part and its pictures beside it", "[gltf]") {
  TempFolder folder;
  Files files;
  files.files["brick wall.png"] = png(3, {1, 2, 3});
  Diagnostics diag;
  auto world = parse(triangle("T", with_picture("brick wall.png")), diag);
  REQUIRE(write(*world, {.binary = false}, &files, folder / "my room.gltf", diag));
  CHECK(folder.file_count() == 3);
  auto j = json::parse(folder.read("my room.gltf"));
  CHECK(j["buffers"][0]["uri"] == "my%20room.bin");
  CHECK(j["buffers"][0]["byteLength"] == folder.read("my room.bin").size());
  CHECK(j["images"][0]["uri"] == "my%20room_brick%20wall.png");
  CHECK_FALSE(j["images"][0].contains("bufferView"));
  CHECK(folder.read("my room_brick wall.png") == files.files["brick wall.png"]);
}

TEST_CASE("Pictures of one name in two folders become two files", "[gltf]") {
  TempFolder folder;
  Files files;
  files.files["a/x.png"] = png(3, {1, 2, 3});
  files.files["b/x.png"] = png(3, {4, 5, 6});
  Diagnostics diag;
  auto world = parse(triangle("A", with_picture("a/x.png")) + triangle("B", with_picture("b/x.png")), diag);
  REQUIRE(write(*world, {.binary = false}, &files, folder / "w.gltf", diag));
  CHECK(folder.read("w_x.png") == files.files["a/x.png"]);
  CHECK(folder.read("w_2_x.png") == files.files["b/x.png"]);
}

TEST_CASE("A DEF name leads to no other folder", "[gltf]") {
  TempFolder folder;
  Diagnostics diag;
  auto world = parse(triangle("T", "appearance Appearance { texture DEF a/b PixelTexture { image 1 1 1 7 } }"), diag);
  REQUIRE(write(*world, {.binary = false}, nullptr, folder / "w.gltf", diag));
  CHECK(folder.read("w_a_b.png").starts_with("\x89PNG"));
}

TEST_CASE("Nothing is left behind when one of the files cannot be written", "[gltf]") {
  TempFolder folder;
  std::filesystem::create_directory(folder.path() / "w.bin");
  Diagnostics diag;
  auto world = parse(triangle("T"), diag);
  CHECK_FALSE(write(*world, {.binary = false}, nullptr, folder / "w.gltf", diag));
  CHECK(diag.count(Diag::cannot_write) == 1);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("Names are kept as they are, but for bytes that are no text", "[gltf]") {
  auto g = convert(triangle("_7-a%/é") + "DEF Same Group {} DEF Same Group {}");
  CHECK(g.node("_7-a%/é").contains("mesh"));
  CHECK(g.j["nodes"][1]["name"] == "Same");
  CHECK(g.j["nodes"][2]["name"] == "Same");

  Diagnostics diag;
  TempFolder folder;
  auto world = parse("Group {}", diag);
  world->scene.set_name(world->scene.main.roots[0], "a\xff\"\\\n");
  REQUIRE(write(*world, {}, nullptr, folder / "n.glb", diag));
  auto bytes = folder.read("n.glb");
  CHECK(json::parse(bytes.substr(20, word(bytes, 12)))["nodes"][0]["name"] == "a\xef\xbf\xbd\"\\\n");
}

// -- everything else

TEST_CASE("Nodes without a counterpart are kept where they are", "[gltf]") {
  auto g = convert(
      "DEF A Group { children [ DEF TS TimeSensor { loop TRUE cycleInterval 2 } DEF I PositionInterpolator { key [0 1] "
      "keyValue [0 0 0, 1 2 3] } ] }"
      "Sound { source DEF C AudioClip { url \"a.wav\" } } Background { skyColor [0 0 1] }"
      "DEF S Script { field SFNode target USE A field SFFloat f 0.5 eventIn SFTime click url \"javascript: x\" }"
      "ROUTE TS.time TO S.click ROUTE TS.fraction_changed TO I.set_fraction");
  auto extras = [&](std::string_view name) { return g.node(name)["extras"]["vrml97"]; };
  CHECK(g.node("A")["children"].size() == 2);
  CHECK(extras("TS") == json::parse(R"({"TimeSensor": {"loop": true, "cycleInterval": 2}})"));
  CHECK(extras("I") == json::parse(R"({"PositionInterpolator": {"key": [0, 1], "keyValue": [0, 0, 0, 1, 2, 3]}})"));
  CHECK(
      extras("S") ==
      json::parse(
          R"({"Script": {"url": ["javascript: x"], "interface": [["field", "SFNode", "target", {"Group": {"USE": "A"}}],
    ["field", "SFFloat", "f", 0.5], ["eventIn", "SFTime", "click"]]}})"));
  CHECK(g.j["nodes"][3]["extras"]["vrml97"] ==
        json::parse(R"({"Sound": {"source": {"AudioClip": {"DEF": "C", "url": ["a.wav"]}}}})"));
  CHECK(g.j["scenes"][0]["extras"]["vrml97"]["routes"] ==
        json({"TS.time TO S.click", "TS.fraction_changed TO I.set_fraction"}));
  CHECK(g.messages(Diag::no_gltf_node) ==
        std::vector{
            "no counterpart in glTF, kept in extras: Background, PositionInterpolator, Script, Sound, TimeSensor"s});
  CHECK(g.messages(Diag::no_gltf_route) ==
        std::vector{"ROUTEs have no counterpart in glTF (2 of them); kept in extras"s});
}

TEST_CASE("WorldInfo and the leading comment belong to the asset", "[gltf]") {
  auto g = convert("# made by hand\nWorldInfo { title \"Pump\" info [ \"a\", \"b\" ] } WorldInfo { title \"other\" }");
  CHECK(g.j["asset"]["extras"]["vrml97"] ==
        json::parse(R"({"comment": "# made by hand\n", "WorldInfo": {"title": "Pump", "info": ["a", "b"]}})"));
  CHECK(g.j["scenes"][0]["name"] == "Pump");
  CHECK(g.messages(Diag::no_gltf_node).empty());
}

TEST_CASE("Unknown nodes show their children and keep their fields", "[gltf]") {
  auto g = convert("DEF U Foo { a 1 b [ 1 2 ] children [ " + triangle("T") + " ] }");
  CHECK(g.node("U")["children"].size() == 1);
  CHECK(
      g.node("U")["extras"]["vrml97"] ==
      json::parse(
          R"({"Foo": {"a": {"verbatim": "1"}, "b": {"verbatim": "[ 1 2 ]"}, "children": [{"Shape": {"USE": "T"}}]}})"));
}

TEST_CASE("Unknown fields of known nodes are kept", "[gltf]") {
  auto g = convert("DEF A Group { tag \"P-101\" }");
  CHECK(g.node("A")["extras"]["vrml97"]["Group"]["tag"] == json({{"verbatim", "\"P-101\""}}));
}

TEST_CASE("Declarations of prototypes are kept", "[gltf]") {
  auto g = convert(
      "PROTO Bolt [ field SFFloat r 0.5 eventIn SFTime t ] { DEF T Transform { children Shape { geometry Cylinder { "
      "radius IS r } } } }"
      "EXTERNPROTO Nut [ field SFFloat r ] \"nut.wrl\"");
  CHECK(g.j["scenes"][0]["extras"]["vrml97"]["protos"][0] ==
        json::parse(R"({"PROTO": "Bolt", "interface": [["field", "SFFloat", "r", 0.5], ["eventIn", "SFTime", "t"]],
    "body": [{"Transform": {"DEF": "T", "children": [{"Shape": {"geometry": {"Cylinder": {"radius": {"IS": "r"}}}}}]}}]})"));
  CHECK(g.j["scenes"][0]["extras"]["vrml97"]["protos"][1]["EXTERNPROTO"] == "Nut");
  CHECK(g.j["scenes"][0]["extras"]["vrml97"]["protos"][1]["url"] == json({"nut.wrl"}));
}

TEST_CASE("Prototypes in the bodies of others are in the same list", "[gltf]") {
  auto g = convert("PROTO A [] { PROTO B [] { PROTO C [] { Group {} } Group {} } Group {} } PROTO D [] { Group {} }");
  const auto& protos = g.j["scenes"][0]["extras"]["vrml97"]["protos"];
  REQUIRE(protos.size() == 4);
  std::vector<std::string> lines;
  for (const auto& p : protos)
    lines.push_back(p["PROTO"].get<std::string>() + " in " + p.value("in", json("none")).dump());
  CHECK(lines == std::vector<std::string>{"A in \"none\"", "D in \"none\"", "B in 0", "C in 2"});
}

TEST_CASE("Long fields are written with the first instance only", "[gltf]") {
  std::string keys;
  for (int i = 0; i < 100; ++i) keys += std::to_string(i) + " ";
  auto g = convert("DEF A Group { children [ DEF I ScalarInterpolator { key [ " + keys +
                   " ] } Anchor { url \"x\" } Switch { choice Group {} } ] } USE A USE A");
  std::size_t with_keys = 0, with_url = 0, with_choice = 0;
  for (const auto& n : g.j["nodes"]) {
    auto e = n.value("/extras/vrml97"_json_pointer, json::object());
    with_keys += e.contains("/ScalarInterpolator/key"_json_pointer);
    with_url += e.contains("/Anchor/url"_json_pointer);
    with_choice += e.contains("/Switch/choice"_json_pointer);
  }
  CHECK(with_keys == 1);
  CHECK(with_url == 3);
  CHECK(with_choice == 1);
}

TEST_CASE("Extras, lights and cameras can be left out", "[gltf]") {
  auto g = convert(
      "DEF T TimeSensor {} Viewpoint {} PointLight {} WorldInfo { title \"t\" } NavigationInfo {} DEF A Anchor { url "
      "\"u\" }",
      nullptr, {.lights = false, .cameras = false, .extras = false});
  CHECK_FALSE(g.j.contains("cameras"));
  CHECK_FALSE(g.j.contains("extensions"));
  CHECK(g.j.dump().find("extras") == std::string::npos);
  CHECK(g.node("T").size() == 1);
}
