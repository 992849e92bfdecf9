// Each row of the mapping from VRML97 to glTF, as numbers in the file that is written.
#include "writers/gltf.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "parsers/parsers.h"
#include "passes/pipeline.h"
#include "scenegraph/nodes.h"
#include "scenegraph/transform.h"
#include "tests/unit/temp_folder.h"
#include "writers/gltf_cameras.h"
#include "writers/gltf_color.h"
#include "writers/gltf_images.h"
#include "writers/gltf_materials.h"
#include "writers/gltf_origin.h"
#include "writers/gltf_store.h"
#include "writers/gltf_texture_transform.h"
#include "writers/gltf_transform.h"

using namespace wrlkit;
using namespace std::literals;
using json = nlohmann::json;

namespace {

constexpr double pi = std::numbers::pi;

/// Files that exist in the memory of a test.
class Files final : public Resources {
 public:
  std::map<std::string, std::string, std::less<>> files;
  int decoded = 0;

  std::shared_ptr<const Blob> bytes(std::span<const std::string_view> urls, Span, Diagnostics&) override {
    auto f = files.find(urls[0]);
    if (f == files.end()) return nullptr;
    auto& known = blobs_[f->first];
    if (!known)
      known = std::make_shared<Blob>(Blob{f->first.substr(f->first.rfind('/') + 1), f->second, sniff_mime(f->second)});
    return known;
  }
  std::shared_ptr<const Image> image(std::span<const std::string_view> urls, Span where, Diagnostics& diag) override {
    auto blob = bytes(urls, where, diag);
    if (!blob) return nullptr;
    ++decoded;
    std::string error;
    auto image = decode_image(blob->bytes, blob->name, error);
    return image ? std::make_shared<const Image>(std::move(*image)) : nullptr;
  }
  std::shared_ptr<const Scene> world(std::span<const std::string_view>, Span, Diagnostics&) override { return nullptr; }

 private:
  std::map<std::string, std::shared_ptr<const Blob>> blobs_;
};

std::uint32_t word(std::string_view s, std::size_t at) {
  std::uint32_t v;
  std::memcpy(&v, s.data() + at, 4);
  return v;
}

/// A world that was converted: its JSON, its binary part, what was reported.
struct Gltf {
  bool written = false;
  std::string bytes, bin;
  json j;
  Diagnostics diag;

  json node(std::string_view name) const {
    for (const auto& n : j["nodes"])
      if (n.value("name", "") == name) return n;
    FAIL("no node " << name);
    return {};
  }
  json mesh_of(std::string_view name) const { return j["meshes"][node(name)["mesh"].get<std::size_t>()]; }
  json primitive(std::string_view name) const { return mesh_of(name)["primitives"][0]; }
  json material(std::string_view name) const { return j["materials"][primitive(name)["material"].get<std::size_t>()]; }
  json view(std::size_t accessor) const {
    return j["bufferViews"][j["accessors"][accessor]["bufferView"].get<std::size_t>()];
  }

  template <class T>
  std::vector<T> values(std::size_t accessor, std::size_t arity) const {
    const auto& a = j["accessors"][accessor];
    std::vector<T> out(a["count"].get<std::size_t>() * arity);
    std::size_t at = view(accessor).value("byteOffset", std::size_t{0}) + a.value("byteOffset", std::size_t{0});
    REQUIRE(at % sizeof(T) == 0);
    REQUIRE(at + out.size() * sizeof(T) <= bin.size());
    std::memcpy(out.data(), bin.data() + at, out.size() * sizeof(T));
    return out;
  }
  std::vector<float> attribute(std::string_view node, const char* name, std::size_t arity) const {
    return values<float>(primitive(node)["attributes"].at(name).get<std::size_t>(), arity);
  }
  /// Corners of the triangles of a node's mesh.
  std::vector<std::array<float, 3>> corners(std::string_view node) const {
    auto p = primitive(node);
    auto positions = attribute(node, "POSITION", 3);
    std::vector<std::uint32_t> index;
    if (p.contains("indices")) {
      auto a = p["indices"].get<std::size_t>();
      if (j["accessors"][a]["componentType"] == 5125)
        index = values<std::uint32_t>(a, 1);
      else
        for (auto i : values<std::uint16_t>(a, 1)) index.push_back(i);
    } else {
      for (std::uint32_t i = 0; i < positions.size() / 3; ++i) index.push_back(i);
    }
    std::vector<std::array<float, 3>> out;
    for (auto i : index) out.push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
    return out;
  }
  std::string picture(std::size_t image) const {
    const auto& v = j["bufferViews"][j["images"][image]["bufferView"].get<std::size_t>()];
    return bin.substr(v.value("byteOffset", std::size_t{0}), v["byteLength"].get<std::size_t>());
  }
  std::vector<std::string> messages(Diag id) const {
    std::vector<std::string> out;
    for (const auto& m : diag.messages())
      if (m.id == id) out.push_back(m.text());
    return out;
  }
};

std::unique_ptr<World> parse(std::string_view text, Diagnostics& diag) {
  auto world = parse_world("#VRML V2.0 utf8\n" + std::string(text), "test.wrl", {}, diag);
  REQUIRE(world);
  return world;
}

bool write(World& world, const GltfOptions& options, Files* files, const std::string& path, Diagnostics& diag) {
  std::string why;
  auto pipeline = Pipeline::parse("tessellate{triangles=false,texcoords=true},normals,triangulate", why);
  REQUIRE(pipeline);
  Statistics stats;
  PassContext context{diag, stats, files};
  auto meshes = pipeline->run_lazily(world.scene, context);
  REQUIRE(meshes);
  return write_gltf(world.scene, meshes, options, files, path, diag);
}

Gltf convert(std::string_view text, Files* files = nullptr, GltfOptions options = {}) {
  TempFolder folder;
  Gltf g;
  auto world = parse(text, g.diag);
  g.written = write(*world, options, files, folder / "out.glb", g.diag);
  g.bytes = folder.read("out.glb");
  if (!g.written) return g;
  auto n = word(g.bytes, 12);
  g.j = json::parse(g.bytes.substr(20, n));
  if (g.bytes.size() > 20 + n) g.bin = g.bytes.substr(28 + n);
  return g;
}

/// A triangle in the plane of X and Y, as the geometry of a Shape with that name.
std::string triangle(std::string_view name, std::string_view appearance = "", std::string_view fields = "") {
  return "DEF " + std::string(name) + " Shape { " + std::string(appearance) +
         " geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 1 0 0, 0 1 0] } coordIndex [0 1 2 -1] " +
         std::string(fields) + " } }\n";
}

std::string with_material(std::string_view material) {
  return "appearance Appearance { material Material { " + std::string(material) + " } }";
}

std::string with_picture(std::string_view url,
                         std::string_view material = "material Material { diffuseColor 0.5 0.25 1 }",
                         std::string_view more = "") {
  return "appearance Appearance { " + std::string(material) + " texture ImageTexture { url \"" + std::string(url) +
         "\" " + std::string(more) + "} }";
}

std::string png(int channels, std::vector<std::uint8_t> pixels, int width = 1) {
  std::string error;
  int height = static_cast<int>(pixels.size()) / channels / width;
  auto bytes = encode_png({width, height, channels, std::move(pixels)}, error);
  REQUIRE(bytes);
  return *bytes;
}

std::vector<double> numbers(const json& j) { return j.get<std::vector<double>>(); }


double difference(const Matrix& a, const Matrix& b) {
  double d = 0;
  for (std::size_t i = 0; i < 12; ++i) d = std::max(d, std::abs(a.m[i] - b.m[i]));
  return d;
}

float linear(double v) { return static_cast<float>(gltf::linear(v)); }

}  // namespace

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
  gltf::Box plant{{2400, 0, 3900}, {2600, 40, 4100}}, bolt{{2500.00, 10, 4000}, {2500.02, 10.02, 4000.02}};
  CHECK_FALSE(gltf::world_origin(plant));
  CHECK_FALSE(gltf::world_origin(bolt));
  CHECK_FALSE(gltf::mesh_origin(plant));
  CHECK(gltf::mesh_origin(bolt));
  gltf::Box millimetres{{0, 0, 0}, {30000, 20000, 5000}};
  CHECK_FALSE(gltf::world_origin(millimetres));
  gltf::Box grid{{4500000, 300000, 0}, {4500200, 300200, 40}};
  REQUIRE(gltf::world_origin(grid));
  CHECK(*gltf::world_origin(grid) == Vec3{4500224, 300032, 0});  // multiples of 256, the power of two below its extent
}

// -- materials

TEST_CASE("Material", "[gltf]") {
  auto g = convert(triangle("A",
                            "appearance Appearance { material DEF Red Material { diffuseColor 0.8 0.2 0.02 "
                            "emissiveColor 0.1 0 0 transparency 0.25 } }") +
                   triangle("B", "appearance DEF Look Appearance { material Material {} }") + triangle("C") +
                   triangle("D", "appearance Appearance {}"));
  auto a = g.material("A");
  CHECK(a["name"] == "Red");
  auto color = a["pbrMetallicRoughness"]["baseColorFactor"];
  CHECK(color[0].get<float>() == linear(0.8));
  CHECK(color[1].get<float>() == linear(0.2));
  CHECK(color[2].get<float>() == Approx(0.02 / 12.92));
  CHECK(color[3] == 0.75);
  CHECK(a["alphaMode"] == "BLEND");
  CHECK(a["emissiveFactor"][0].get<float>() == linear(0.1));
  CHECK(a["pbrMetallicRoughness"]["metallicFactor"] == 0);
  CHECK_FALSE(a["pbrMetallicRoughness"].contains("roughnessFactor"));
  CHECK_FALSE(a.contains("extensions"));
  CHECK_FALSE(a.contains("extras"));

  CHECK(g.material("B")["name"] == "Look");
  CHECK_FALSE(g.material("B").contains("alphaMode"));
  CHECK(g.material("C")["extensions"].contains("KHR_materials_unlit"));
  CHECK_FALSE(g.material("C")["pbrMetallicRoughness"].contains("baseColorFactor"));
  CHECK(g.primitive("C")["material"] == g.primitive("D")["material"]);
}

TEST_CASE("Shininess and specularColor are roughness, and are kept", "[gltf]") {
  CHECK(gltf::roughness(0.2, {0, 0, 0}) == 1);
  CHECK(gltf::roughness(0.2, {1, 1, 1}) == Approx(std::pow(2 / 27.6, 0.25)));
  CHECK(gltf::roughness(1, {0, 1, 0}) == Approx(std::pow(2 / 130.0, 0.25)));
  CHECK(gltf::roughness(1, {0.5, 0, 0}) == Approx(std::pow(0.02, 0.25)));
  CHECK(gltf::roughness(0.2, {0.01, 0, 0}) == 1);
  CHECK(gltf::roughness(0, {1, 1, 1}) == 1);
  CHECK(gltf::roughness(std::nan(""), {0, 7, 0}) == 1);
  auto m =
      convert(triangle("A", with_material("shininess 0.2 specularColor 1 1 1 ambientIntensity 0.5"))).material("A");
  CHECK(m["pbrMetallicRoughness"]["roughnessFactor"].get<float>() == Approx(std::pow(2 / 27.6, 0.25)));
  CHECK(m["extras"]["vrml97"]["Material"] == json::parse(R"({"specularColor": [1, 1, 1], "ambientIntensity": 0.5})"));
}

TEST_CASE("Equal appearances are one material, but for their names", "[gltf]") {
  auto g = convert(triangle("A", with_material("diffuseColor 1 0 0")) +
                   triangle("B", with_material("diffuseColor 1 0 0 transparency 0")) +
                   triangle("C", "appearance Appearance { material DEF M Material { diffuseColor 1 0 0 } }"));
  CHECK(g.j["materials"].size() == 2);
  CHECK(g.primitive("A")["material"] == g.primitive("B")["material"]);
}

// -- textures

TEST_CASE("PNG and JPEG are embedded as they are, once", "[gltf]") {
  Files files;
  files.files["a.png"] = png(3, {1, 2, 3});
  std::string error;
  files.files["b.jpg"] = *encode_jpeg({1, 1, 3, {9, 9, 9}}, 90, error);
  auto g = convert(triangle("A", with_picture("a.png")) + triangle("B", with_picture("b.jpg")) +
                       triangle("C", with_picture("a.png", "")),
                   &files);
  CHECK(g.j["images"].size() == 2);
  CHECK(g.picture(0) == files.files["a.png"]);
  CHECK(g.picture(1) == files.files["b.jpg"]);
  CHECK(g.j["images"][0]["mimeType"] == "image/png");
  CHECK(g.j["images"][1]["mimeType"] == "image/jpeg");
  CHECK(g.j["images"][0]["name"] == "a.png");
  CHECK(g.j["textures"].size() == 2);
  CHECK(g.j["textures"][0]["extras"]["vrml97"]["ImageTexture"]["url"] == json({"a.png"}));
  CHECK(files.decoded == 0);
}

TEST_CASE("Other pictures become PNG", "[gltf]") {
  Files files;
  files.files["dot.gif"] =
      "GIF89a\x01\x00\x01\x00\x80\x00\x00\xff\x00\x00\x00\x00\xff\x2c\x00\x00\x00\x00\x01\x00\x01\x00\x00\x02\x02\x44\x01\x00\x3b"s;
  auto g = convert(triangle("A", with_picture("dot.gif")), &files);
  REQUIRE(g.j["images"].size() == 1);
  CHECK(g.j["images"][0]["mimeType"] == "image/png");
  CHECK(g.j["images"][0]["name"] == "dot.png");
  std::string error;
  auto image = decode_image(g.picture(0), "", error);
  REQUIRE(image);
  CHECK(image->pixels == std::vector<std::uint8_t>{255, 0, 0});
}

TEST_CASE("A PNG in another colour space loses the chunk that says so", "[gltf]") {
  auto plain = png(3, {1, 2, 3});
  std::string gamma("\0\0\0\x04gAMA\0\x01\x86\xa0\x31\xe8\x96\x5f", 16);  // 1.0
  auto odd = plain.substr(0, 33) + gamma + plain.substr(33);
  auto portable = gltf::portable_image(odd, "image/png");
  CHECK(portable.usable);
  CHECK(portable.cleaned == plain);
  std::string usual("\0\0\0\x04gAMA\0\0\xb1\x8f\x0b\xfc\x61\x05", 16);  // 1 / 2.2
  CHECK_FALSE(gltf::portable_image(plain.substr(0, 33) + usual + plain.substr(33), "image/png").cleaned);
  CHECK_FALSE(gltf::portable_image(plain.substr(0, 40), "image/png").usable);
  CHECK_FALSE(gltf::portable_image("\xff\xd8\xff\xc0\0\x14\x08\0\x01\0\x01\x04"sv, "image/jpeg").usable);
}

TEST_CASE("PixelTexture begins at the bottom", "[gltf]") {
  auto g = convert(triangle(
      "A", "appearance Appearance { texture DEF Px PixelTexture { image 1 2 3 0xFF0000 0x0000FF repeatS FALSE } }"));
  REQUIRE(g.j["images"].size() == 1);
  std::string error;
  auto image = decode_image(g.picture(0), "", error);
  REQUIRE(image);
  CHECK(image->pixels == std::vector<std::uint8_t>{0, 0, 255, 255, 0, 0});
  CHECK(g.j["textures"][0]["name"] == "Px");
  CHECK(g.j["samplers"][0]["wrapS"] == 33071);
  CHECK_FALSE(g.j["samplers"][0].contains("wrapT"));
  CHECK_FALSE(
      convert(triangle("A", "appearance Appearance { texture PixelTexture { image 0 0 0 } }")).j.contains("images"));
}

TEST_CASE("A picture takes the place of the colour, or is multiplied by it", "[gltf]") {
  Files files;
  files.files["1.png"] = png(1, {100});
  files.files["2.png"] = png(2, {100, 100});
  files.files["3.png"] = png(3, {1, 2, 3});
  files.files["4.png"] = png(4, {1, 2, 3, 100});
  const std::string material = "material Material { diffuseColor 0.5 0.25 1 transparency 0.5 }",
                    color = "color Color { color [1 0 0, 1 0 0, 1 0 0] }";
  auto base = [](const json& m) { return m["pbrMetallicRoughness"].value("baseColorFactor", json({1, 1, 1, 1})); };
  auto diffuse = json({linear(0.5), linear(0.25), 1.f, 0.5f});
  for (int channels = 1; channels <= 4; ++channels) {
    auto name = std::to_string(channels) + ".png";
    auto g = convert(triangle("A", with_picture(name, material)) + triangle("B", with_picture(name, material), color) +
                         triangle("C", with_picture(name, ""), color),
                     &files);
    INFO(channels);
    bool replaces = channels >= 3, alpha = channels % 2 == 0;
    auto a = base(g.material("A")), b = base(g.material("B"));
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(a[i].get<float>() == (replaces ? 1.f : diffuse[i].get<float>()));
      CHECK(b[i] == 1);
    }
    CHECK(a[3] == (alpha ? 1 : 0.5));
    CHECK(g.material("A")["alphaMode"] == "BLEND");
    CHECK(g.primitive("B")["attributes"].contains(replaces ? "_COLOR" : "COLOR_0"));
    CHECK_FALSE(g.primitive("B")["attributes"].contains(replaces ? "COLOR_0" : "_COLOR"));
    CHECK(g.primitive("C")["attributes"].contains(replaces ? "_COLOR" : "COLOR_0"));
    CHECK(g.material("C").contains("extensions"));
    // What a picture hides is kept.
    auto kept = g.material("A").value("extras", json::object());
    CHECK((replaces ? kept["vrml97"]["Material"]["diffuseColor"] == json({0.5, 0.25, 1})
                    : !kept.contains("diffuseColor")));
    CHECK((!alpha || kept["vrml97"]["Material"]["transparency"] == 0.5));
  }
}

TEST_CASE("Alpha is cut or blended by what the picture has", "[gltf]") {
  Files files;
  files.files["full.png"] = png(4, {1, 2, 3, 255});
  files.files["mask.png"] = png(4, {1, 2, 3, 255, 1, 2, 3, 0});
  files.files["soft.png"] = png(2, {1, 254});
  auto mode = [&](const char* name) {
    return convert(triangle("A", with_picture(name)), &files).material("A").value("alphaMode", "OPAQUE");
  };
  CHECK(mode("full.png") == "OPAQUE");
  CHECK(mode("mask.png") == "MASK");
  CHECK(mode("soft.png") == "BLEND");
}

TEST_CASE("A picture that cannot be had leaves the material, and its node in extras", "[gltf]") {
  Files files;
  auto g = convert(triangle("A", with_picture("no.png")) +
                       triangle("B", "appearance Appearance { texture MovieTexture { url \"m.mpg\" speed 2 } }"),
                   &files);
  CHECK_FALSE(g.material("A")["pbrMetallicRoughness"].contains("baseColorTexture"));
  CHECK(g.material("A")["pbrMetallicRoughness"]["baseColorFactor"][1].get<float>() == linear(0.25));
  CHECK(g.material("A")["extras"]["vrml97"] == json::parse(R"({"ImageTexture": {"url": ["no.png"]}})"));
  CHECK(g.material("B")["extras"]["vrml97"] == json::parse(R"({"MovieTexture": {"url": ["m.mpg"], "speed": 2}})"));
  CHECK(g.diag.count(Diag::no_gltf_movie) == 1);
  CHECK_FALSE(g.j.contains("textures"));
}

namespace {

gltf::UvAffine affine(std::string_view fields) {
  Diagnostics diag;
  auto world = parse(
      "Shape { appearance Appearance { textureTransform TextureTransform { " + std::string(fields) + " } } }", diag);
  Scene& s = world->scene;
  return gltf::uv_affine(s,
                         s.get(s.get(s.main.roots[0], nodes::shape::appearance), nodes::appearance::textureTransform));
}

/// The matrix of KHR_texture_transform, T R S, on coordinates of glTF.
Vec2 apply(const gltf::UvTransform& t, double u, double v) {
  u *= t.scale[0], v *= t.scale[1];
  double c = std::cos(t.rotation), s = std::sin(t.rotation);
  return {c * u + s * v + t.offset[0], -s * u + c * v + t.offset[1]};
}

}  // namespace

TEST_CASE("TextureTransform in VRML's coordinates", "[gltf]") {
  auto a = affine("translation 0.5 0.25 scale 2 4 center 0.5 0.5");
  CHECK(a(0, 0)[0] == Approx(2 * (0.5 + 0.5) - 0.5));
  CHECK(a(0, 0)[1] == Approx(4 * (0.25 + 0.5) - 0.5));
  // -C S R C T: turned first, then scaled.
  auto b = affine("rotation 1.5707963267948966 scale 2 3");
  CHECK(b(1, 0)[0] == Approx(0).margin(1e-15));
  CHECK(b(1, 0)[1] == Approx(3));
  CHECK(b(0, 1)[0] == Approx(-2));
}

TEST_CASE("KHR_texture_transform says the same with V turned round", "[gltf]") {
  for (auto fields :
       {"translation 0.5 0.25", "scale 2 -3 center 0.5 0.5", "rotation 0.3 center 0.2 0.9",
        "rotation -2 scale 1.5 1.5 translation 1 2", "rotation 3.141592653589793 scale 2 5 center 0.1 0.2"}) {
    INFO(fields);
    auto a = affine(fields);
    auto t = gltf::uv_transform(a);
    REQUIRE(t);
    for (auto [s, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.3, 0.8}}) {
      CHECK(apply(*t, s, 1 - v)[0] == Approx(a(s, v)[0]));
      CHECK(apply(*t, s, 1 - v)[1] == Approx(1 - a(s, v)[1]));
    }
  }
  CHECK_FALSE(gltf::uv_transform(affine("rotation 0.3 scale 1 2")));
}

TEST_CASE("A TextureTransform that glTF cannot say is applied to the coordinates", "[gltf]") {
  Files files;
  files.files["a.png"] = png(3, {1, 2, 3});
  std::string texcoord = "texCoord TextureCoordinate { point [0 0, 1 0, 0.25 1] }";
  auto appearance = [](std::string_view t) {
    return "appearance Appearance { texture ImageTexture { url \"a.png\" } textureTransform TextureTransform { " +
           std::string(t) + " } }";
  };
  auto g = convert(triangle("A", appearance("scale 2 3 translation 0.5 0"), texcoord) +
                       triangle("B", appearance("rotation 0.3 scale 1 2"), texcoord),
                   &files);
  auto info = [&](std::string_view n) { return g.material(n)["pbrMetallicRoughness"]["baseColorTexture"]; };
  CHECK(info("A")["extensions"]["KHR_texture_transform"] == json::parse(R"({"offset": [1, -2], "scale": [2, 3]})"));
  CHECK(info("A")["extras"]["vrml97"]["TextureTransform"]["translation"] == json({0.5, 0}));
  CHECK(g.j["extensionsUsed"] == json({"KHR_materials_unlit", "KHR_texture_transform"}));
  CHECK(g.attribute("A", "TEXCOORD_0", 2) == std::vector<float>{0, 1, 1, 1, 0.25f, 0});
  CHECK_FALSE(info("B").contains("extensions"));
  CHECK(g.primitive("A")["attributes"]["POSITION"] == g.primitive("B")["attributes"]["POSITION"]);
  auto uv = g.attribute("B", "TEXCOORD_0", 2);
  CHECK(uv[2] == Approx(std::cos(0.3)));
  CHECK(uv[3] == Approx(1 - 2 * std::sin(0.3)));
}

// -- lights, cameras

TEST_CASE("Lights", "[gltf]") {
  auto g = convert(
      "DEF D DirectionalLight { direction 1 0 0 intensity 0.5 color 1 0.5 0 } "
      "DEF S SpotLight { location 1 2 3 direction 0 -1 0 cutOffAngle 0.5 beamWidth 0.2 radius 7 attenuation 0 0 1 }"
      "DEF Off PointLight { on FALSE } NavigationInfo { headlight FALSE }");
  auto light = [&](std::string_view name) {
    return g.j["extensions"]["KHR_lights_punctual"]["lights"]
              [g.node(name)["extensions"]["KHR_lights_punctual"]["light"].get<std::size_t>()];
  };
  CHECK(g.j["extensionsUsed"] == json({"KHR_lights_punctual"}));
  CHECK(light("D")["type"] == "directional");
  CHECK(light("D")["intensity"].get<double>() == Approx(pi / 2));
  CHECK(light("D")["color"][1].get<float>() == linear(0.5));
  CHECK_FALSE(light("D").contains("range"));
  auto turned = gltf::rotate(gltf::looking_along({1, 0, 0}), {0, 0, -1});
  CHECK(turned[0] == Approx(1));
  auto q = numbers(g.node("D")["rotation"]);
  CHECK(q[1] == Approx(-std::sqrt(0.5)));
  CHECK(q[3] == Approx(std::sqrt(0.5)));

  CHECK(g.node("S")["translation"] == json({1, 2, 3}));
  CHECK(light("S")["type"] == "spot");
  CHECK(light("S")["spot"] == json({{"innerConeAngle", 0.2}, {"outerConeAngle", 0.5}}));
  CHECK(light("S")["range"] == 7);
  CHECK_FALSE(g.node("Off").contains("extensions"));
  CHECK(g.node("Off")["extras"]["vrml97"]["PointLight"]["on"] == false);
  CHECK(g.j["extensions"]["KHR_lights_punctual"]["lights"].size() == 2);
}

TEST_CASE("A point light is right at the mean distance of the world", "[gltf]") {
  std::string box = "Shape { geometry Box { size 2 2 2 } } NavigationInfo { headlight FALSE } ";
  auto intensity = [&](std::string_view light) {
    return convert(box + std::string(light))
        .j["extensions"]["KHR_lights_punctual"]["lights"][0]["intensity"]
        .get<double>();
  };
  // From (0, 3, 0), the mean square of the distances to the points of the cube is 3^2 + 3 / 3.
  CHECK(intensity("PointLight { location 0 3 0 }") == Approx(pi * 10));
  CHECK(intensity("PointLight { location 0 3 0 attenuation 0 0 1 }") == Approx(pi));
  CHECK(intensity("PointLight { location 0 3 0 attenuation 0 2 0 intensity 0.5 }") ==
        Approx(0.5 * pi * 10 / (2 * std::sqrt(10.0))));
  // It reaches a ball with a mean square of 3/5 2^2.
  CHECK(intensity("PointLight { location 0 3 0 radius 2 }") == Approx(pi * 2.4));
  auto scaled =
      convert(box + "Transform { scale 2 2 2 children PointLight { location 0 1.5 0 radius 10 attenuation 0 0 1 } }");
  auto light = scaled.j["extensions"]["KHR_lights_punctual"]["lights"][0];
  CHECK(light["range"].get<double>() == Approx(20));
  CHECK(light["intensity"].get<double>() == Approx(pi * 4));
}

TEST_CASE("Directions behind and degenerate cones", "[gltf]") {
  for (Vec3 d : {Vec3{0, 0, 1}, {0, 0, -1}, {1e-12, 0, 1}, {-3, 2, 5}, {0, 1e-3, 0}}) {
    auto to = gltf::rotate(gltf::looking_along(d), {0, 0, -1});
    double length = std::hypot(d[0], d[1], d[2]);
    for (std::size_t i = 0; i < 3; ++i) CHECK(to[i] == Approx(d[i] / length).margin(1e-8));
  }
  auto g = convert("SpotLight { cutOffAngle 0.5 beamWidth 1.5 } SpotLight { cutOffAngle 0 beamWidth 0 }");
  for (const auto& l : g.j["extensions"]["KHR_lights_punctual"]["lights"]) {
    if (l["type"] != "spot") continue;
    CHECK(l["spot"]["innerConeAngle"].get<double>() < l["spot"]["outerConeAngle"].get<double>());
    CHECK(l["spot"]["outerConeAngle"].get<double>() > 0);
  }
}

TEST_CASE("The headlight joins lights of the world's own", "[gltf]") {
  auto lights = [](std::string_view text) {
    return convert(text).j.value("/extensions/KHR_lights_punctual/lights"_json_pointer, json::array()).size();
  };
  CHECK(lights("Viewpoint {}") == 0);
  CHECK(lights("Viewpoint {} DirectionalLight {}") == 2);
  CHECK(lights("DirectionalLight {}") == 2);
  CHECK(lights("DirectionalLight {} NavigationInfo { headlight FALSE }") == 1);
  CHECK(lights("DirectionalLight { on FALSE }") == 0);
  auto g = convert("DEF A Viewpoint {} DEF B Viewpoint {} DirectionalLight {}");
  auto headlight = g.j["nodes"][g.node("A")["children"][0].get<std::size_t>()];
  CHECK(headlight["name"] == "headlight");
  CHECK_FALSE(g.node("B").contains("children"));
}

TEST_CASE("What lights lose is said", "[gltf]") {
  auto g = convert(
      "Group { children DirectionalLight { ambientIntensity 0.5 } } DirectionalLight {} PointLight {} PointLight { "
      "attenuation 0 0 1 }");
  CHECK(g.messages(Diag::no_gltf_value) == std::vector{"DirectionalLight.ambientIntensity cannot be said in glTF"s,
                                                       "PointLight.attenuation cannot be said in glTF"s});
  CHECK(g.diag.count(Diag::no_gltf_light_scope) == 1);
}

TEST_CASE("Viewpoints", "[gltf]") {
  auto g = convert(
      "Shape { geometry Box { size 2 2 2 } } DEF V Viewpoint { position 0 0 9 orientation 0 1 0 1 fieldOfView 1.2 "
      "description \"Front\" } "
      "Viewpoint { description \"Side\" } NavigationInfo { avatarSize [ 0.002 1.6 0.75 ] visibilityLimit 15 }");
  auto v = g.node("V");
  CHECK(v["translation"] == json({0, 0, 9}));
  CHECK(numbers(v["rotation"])[1] == Approx(std::sin(0.5)));
  auto camera = g.j["cameras"][v["camera"].get<std::size_t>()];
  CHECK(camera["type"] == "perspective");
  CHECK(camera["name"] == "V");
  CHECK(camera["perspective"]["yfov"] == 1.2);
  CHECK_FALSE(camera["perspective"].contains("aspectRatio"));
  CHECK(camera["perspective"]["zfar"] == 15);
  CHECK(camera["perspective"]["znear"].get<double>() == Approx(0.001));
  CHECK(v["extras"]["vrml97"]["Viewpoint"]["description"] == "Front");
  CHECK(g.j["cameras"][1]["name"] == "Side");
  CHECK(g.node("Side").contains("camera"));
  CHECK(g.j["scenes"][0]["extras"]["vrml97"]["NavigationInfo"]["visibilityLimit"] == 15);
}

TEST_CASE("Clipping planes follow the size of the world", "[gltf]") {
  auto planes = [](std::string_view size, std::string_view position) {
    auto c = convert("Shape { geometry Box { size " + std::string(size) + " } } Viewpoint { position " +
                     std::string(position) + " }")
                 .j["cameras"][0]["perspective"];
    return std::pair{c["znear"].get<double>(), c["zfar"].get<double>()};
  };
  auto far_corner = [](double half, double z) { return 2 * std::sqrt(2 * half * half + (z + half) * (z + half)); };
  CHECK(planes("200 200 200", "0 0 300").second == Approx(far_corner(100, 300)));
  CHECK(planes("200 200 200", "0 0 300").first == Approx(0.125));
  CHECK(planes("0.02 0.02 0.02", "0 0 0.05").first == Approx(far_corner(0.01, 0.05) / 1000));
  CHECK(planes("200000 200000 200000", "0 0 300000").first == Approx(far_corner(1e5, 3e5) / 1e5));
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
  CHECK(g.messages(Diag::no_gltf_route) == std::vector{"2 ROUTEs have no counterpart in glTF; kept in extras"s});
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
  for (const auto& p : protos) lines.push_back(p["PROTO"].get<std::string>() + " in " + p.value("in", json("none")).dump());
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
