// What programs do: bytes instead of files, scenes made by hand, passes and sinks of their own.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/image/image.h"
#include "base/io/url.h"
#include "convert/wrlkit.h"
#include "passes/pipeline/pass_info.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tests/unit/temp_folder.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;

namespace {

namespace fs = std::filesystem;

/// The current folder, for the time of a test.
class InFolder {
 public:
  explicit InFolder(const fs::path& folder) : before_(fs::current_path()) { fs::current_path(folder); }
  ~InFolder() { fs::current_path(before_); }
  InFolder(const InFolder&) = delete;

 private:
  fs::path before_;
};

/// A PNG of one pixel.
std::string pixel() {
  return *decode_data_url(
      "data:image/"
      "png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg"
      "==");
}

std::string bytes_of(const Document& document, const std::string& ending, const SaveOptions& options = {}) {
  std::string bytes;
  const auto saved = save(
      document, [&](std::string_view piece) { bytes += piece; }, ending, options);
  return saved ? bytes : std::string();
}

bool has_message(const Document& document, std::string_view name) {
  return std::ranges::any_of(document.messages(), [&](const MessageView& m) { return m.name == name; });
}

constexpr auto refers = R"(#VRML V2.0 utf8
EXTERNPROTO Kept [ ] [ "kept.wrl#Kept" ]
Inline { url "part.wrl" }
Kept { }
Shape {
  appearance Appearance { texture ImageTexture { url "pixel.png" } }
  geometry Box { }
})";

/// What the bytes above refer to.
struct Parts {
  TempFolder folder;
  Parts() {
    folder.write("part.wrl", "#VRML V2.0 utf8\nDEF FromPart Shape { geometry Sphere { } }");
    folder.write("kept.wrl", "#VRML V2.0 utf8\nPROTO Kept [ ] { Group { children DEF FromKept Group { } } }");
    folder.write("pixel.png", pixel());
  }
};

/// A box that a program has made.
struct Made {
  World world;
  NodeId shape, box, group;
  Scene& scene = world.scene;

  Made() {
    group = scene.add(nodes::Transform);
    shape = scene.add(nodes::Shape);
    box = scene.add(nodes::Box);
    scene.set(shape, nodes::shape::geometry, box);
    scene.set(group, nodes::transform::children, std::vector{shape});
    scene.main.roots = {group};
  }
  Document document() { return Document(World{.scene = scene}); }
};

}  // namespace

TEST_CASE("made scene: bytes have no folder, so nothing is read that was not allowed", "[made]") {
  const Parts parts;
  const InFolder in(parts.folder.path());
  const auto document = load_bytes(refers, "bytes.wrl");
  REQUIRE(document);
  for (const std::string ending : {".glb", ".wrl", ".x3d"}) {
    const auto bytes = bytes_of(document, ending, {.pipeline = "expand", .embed = true});
    CHECK(bytes.find("FromPart") == bytes.npos);
    CHECK(bytes.find("FromKept") == bytes.npos);
    CHECK(bytes.find("image/png") == bytes.npos);
  }
  CHECK(has_message(document, "url-not-found"));
  for (const auto& lookup : document.lookups()) CHECK(lookup.result.canonical.empty());
}

TEST_CASE("made scene: urls of bytes are looked for below the folders that are allowed", "[made]") {
  const Parts parts;
  const TempFolder elsewhere;
  const InFolder in(elsewhere.path());
  const auto document = load_bytes(refers, "bytes.wrl", {.allow_paths = {parts.folder.path()}});
  const auto bytes = bytes_of(document, ".wrl", {.pipeline = "expand", .embed = true});
  CHECK(bytes.find("FromPart") != bytes.npos);
  CHECK(bytes.find("FromKept") != bytes.npos);
  CHECK(bytes.find("data:image/png;base64") != bytes.npos);
}

TEST_CASE("made scene: buffers of glTF bytes are looked for below the folders that are allowed", "[made]") {
  Made made;
  const TempFolder folder;
  REQUIRE(save(made.document(), folder / "box.gltf", {.extras = Extras::none}));
  const auto text = folder.read("box.gltf");
  const InFolder in(folder.path());
  CHECK(has_message(load_bytes(text, "box.gltf"), "url-not-found"));
  CHECK(load_bytes(text, "box.gltf", {.allow_paths = {folder.path()}}).messages().empty());
}

TEST_CASE("made scene: pictures of a scene that a program makes", "[made]") {
  const Parts parts;
  const InFolder in(parts.folder.path());
  Made made;
  const NodeId appearance = made.scene.add(nodes::Appearance), texture = made.scene.add(nodes::ImageTexture);
  made.scene.set(made.shape, nodes::shape::appearance, appearance);
  made.scene.set(appearance, nodes::appearance::texture, texture);
  made.scene.set(texture, nodes::image_texture::url, "pixel.png");
  CHECK(bytes_of(made.document(), ".glb").find("image/png") == std::string::npos);
  const Document allowed(World{.scene = made.scene}, LoadOptions{.allow_paths = {parts.folder.path()}});
  CHECK(bytes_of(allowed, ".glb").find("image/png") != std::string::npos);
}

TEST_CASE("made scene: urls of nodes that lie in no file lead to the files that they mean", "[made]") {
  const TempFolder folder;
  folder.write("textures/pixel.png", pixel());
  const auto land = folder.write("land/land.wrl", "#VRML V2.0 utf8\nGroup { }");
  folder.write("land/own.png", pixel());
  Document document = load(land, {.allow_paths = {folder / "textures"}});
  REQUIRE(document);
  const NodeId texture = document.scene().add(nodes::ImageTexture);
  document.scene().set(texture, nodes::image_texture::url, "own.png");
  document.scene().main.roots.push_back(texture);
  REQUIRE(save(document, folder / "all.wrl"));
  CHECK(folder.read("all.wrl").find("\"land/own.png\"") != std::string::npos);
  const auto bytes = load_bytes(refers, "bytes.wrl", {.allow_paths = {folder / "textures"}});
  REQUIRE(save(bytes, folder / "bytes.wrl"));
  CHECK(folder.read("bytes.wrl").find("\"textures/pixel.png\"") != std::string::npos);
}

TEST_CASE("made scene: values become those of their fields", "[made]") {
  Scene scene;
  const NodeId cone = scene.add(nodes::Cone), faces = scene.add(nodes::IndexedFaceSet),
               texture = scene.add(nodes::ImageTexture), group = scene.add(nodes::Group),
               time = scene.add(nodes::TimeSensor);
  scene.set(cone, nodes::cone::height, 3, nodes::cone::bottomRadius, 2.5f);
  CHECK(scene.get(cone, nodes::cone::height) == 3);
  CHECK(scene.get(cone, nodes::cone::bottomRadius) == 2.5);
  scene.set(time, nodes::time_sensor::cycleInterval, std::size_t{7});
  CHECK(scene.get(time, nodes::time_sensor::cycleInterval) == 7);
  scene.set(texture, nodes::image_texture::url, "one.png");
  REQUIRE(scene.get(texture, nodes::image_texture::url).size() == 1);
  CHECK(scene.get(texture, nodes::image_texture::url)[0] == "one.png");
  scene.set(faces, nodes::indexed_face_set::coordIndex, 4);
  CHECK(scene.get(faces, nodes::indexed_face_set::coordIndex).size() == 1);
  scene.set(group, nodes::group::children, cone);
  CHECK(scene.get(group, nodes::group::children).size() == 1);
  const NodeId transform = scene.add(nodes::Transform);
  scene.set(transform, nodes::transform::translation, std::vector{1.0});
  CHECK(scene.get(transform, nodes::transform::translation) == Vec3{1, 0, 0});
  CHECK(scene.make(FieldType::SFFloat, 0, std::int32_t{2}).number == 2);

  STATIC_REQUIRE(fits_field<FieldType::SFFloat, int>());
  STATIC_REQUIRE(fits_field<FieldType::SFVec3f, Vec3>());
  STATIC_REQUIRE(fits_field<FieldType::MFVec3f, std::vector<double>>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFFloat, bool>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFFloat, const char*>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFInt32, double>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFBool, const char*>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFRotation, Vec3>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFVec3f, double>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFString, NodeId>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::SFNode, std::vector<NodeId>>());
  STATIC_REQUIRE_FALSE(fits_field<FieldType::MFInt32, std::vector<double>>());
}

namespace {

struct NoOptions {
  void fields(auto&&) {}
};

Outcome need_meshes(Scene& scene, const NoOptions&, PassContext& context) {
  Diagnostics unheard;
  context.stats["need-meshes.meshes"] += verify(scene, Level::mesh, unheard);
  return Outcome::unchanged;
}

Outcome fail_silently(Scene&, const NoOptions&, PassContext&) { return Outcome::failed; }

Outcome fail_at_meshes(MeshJob&, const NoOptions&) { return Outcome::failed; }

Outcome throw_one(Scene&, const NoOptions&, PassContext&) { throw std::runtime_error("a pass"); }

void add_passes() {
  add_pass(pass<need_meshes, NoOptions>("need-meshes", "looks at meshes", Level::mesh, Level::mesh));
  add_pass(pass<fail_silently, NoOptions>("fail-silently", "fails", Level::authored, Level::authored));
  add_pass(pass<fail_at_meshes, NoOptions>("fail-at-meshes", "fails", Level::authored, Level::authored));
  add_pass(pass<throw_one, NoOptions>("throw-one", "throws", Level::authored, Level::authored));
}

}  // namespace

TEST_CASE("made scene: a pass that needs meshes gets them", "[made]") {
  add_passes();
  Made made;
  auto document = made.document();
  std::string why;
  auto pipeline = Pipeline::parse("need-meshes", why);
  REQUIRE(pipeline);
  REQUIRE(pipeline->run(document.scene(), document.context()));
  CHECK(document.context().stats["need-meshes.meshes"] == 1);
  CHECK(bytes_of(made.document(), ".glb", {.pipeline = "need-meshes"}).size() > 100);
}

TEST_CASE("made scene: a pass that fails is named", "[made]") {
  add_passes();
  for (const std::string name : {"fail-silently", "fail-at-meshes"}) {
    CAPTURE(name);
    Made made;
    auto document = made.document();
    std::string why;
    auto pipeline = Pipeline::parse(name, why);
    REQUIRE(pipeline);
    CHECK_FALSE(pipeline->run(document.scene(), document.context()));
    REQUIRE(document.messages().size() == 1);
    CHECK(document.diag().count(Diag::pass_failed) == 1);
    CHECK(document.messages()[0].text.find(name) != std::string::npos);
    CHECK_FALSE(save(document, "none.wrl", {.pipeline = name}));
  }
}

TEST_CASE("made scene: what a pass throws leaves no file and a document that can be used", "[made]") {
  add_passes();
  const TempFolder folder;
  Made made;
  const auto document = made.document();
  CHECK_THROWS_AS(save(document, folder / "none.wrl", {.pipeline = "throw-one"}), std::runtime_error);
  CHECK(folder.file_count() == 0);
  CHECK(save(document, folder / "box.wrl"));
}

TEST_CASE("made scene: what a Sink throws comes out of save", "[made]") {
  Made made;
  const auto document = made.document();
  for (const std::string ending : {".wrl", ".wrz", ".x3d", ".x3dz", ".glb"}) {
    CAPTURE(ending);
    const Sink full = [](std::string_view) { throw std::runtime_error("the disk is full"); };
    CHECK_THROWS_AS(save(document, full, ending), std::runtime_error);
    int pieces = 0;
    const Sink once = [&](std::string_view) {
      if (++pieces > 1) throw std::runtime_error("enough");
    };
    CHECK_NOTHROW([&] {
      try {
        save(document, once, ending);
      } catch (const std::runtime_error&) {
      }
    }());
    CHECK(bytes_of(document, ending).size() > 10);
  }
}

namespace {

class ThrowingMonitor final : public Monitor {
 public:
  void begin(std::string, std::uint64_t, std::string) override { throw std::runtime_error("enough"); }
  void step(std::uint64_t) override { throw std::runtime_error("enough"); }
};

}  // namespace

TEST_CASE("made scene: what a Monitor throws comes out, and leaves no file", "[made]") {
  const TempFolder folder;
  folder.write("box.wrl", "#VRML V2.0 utf8\nShape { geometry Box { } }");
  ThrowingMonitor monitor;
  CHECK_THROWS_AS(convert(folder / "box.wrl", folder / "box.glb", {}, {&monitor}), std::runtime_error);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("made scene: baked light is in what is saved to memory, the same each time", "[made][bake]") {
  auto document = load_bytes(R"(#VRML V2.0 utf8
PointLight { location 0 2 0 }
Shape { appearance Appearance { material Material { } } geometry Box { size 4 0.1 4 } })",
                             "lit.wrl");
  REQUIRE(bake(document, {.density = 2}) == Ending::good);
  const auto n_made = document.resources()->made().size();
  REQUIRE(n_made > 0);
  for (const std::string ending : {".wrl", ".x3d", ".glb"}) {
    CAPTURE(ending);
    const auto once = bytes_of(document, ending);
    CHECK(once.find(ending == ".glb" ? "image/" : "data:image/") != std::string::npos);
    if (ending != ".glb") CHECK(once.find(made_scheme) == std::string::npos);  // extras keep the urls of their pictures
    CHECK(bytes_of(document, ending) == once);
    CHECK(document.resources()->made().size() == n_made);
  }
}

TEST_CASE("made scene: copies of a scene do not add to its memory, and may be worked on by threads", "[made]") {
  Made made;
  Scene copy = made.scene;
  CHECK(&copy.arena() != &made.scene.arena());
  const auto name = copy.keep("kept");
  made.scene = copy;
  CHECK(name == "kept");
}

TEST_CASE("made scene: documents of copies are worked on in several threads", "[made]") {
  const Parts parts;
  const auto path = parts.folder.write("world.wrl", refers);
  const Document original = load(path);
  REQUIRE(original);
  const LoadOptions options{.allow_paths = {parts.folder.path()}};
  std::vector<std::string> bytes(4);
  std::vector<std::thread> threads;
  for (auto& out : bytes)
    threads.emplace_back([&, copy = original.scene()]() mutable {
      for (int i = 0; i < 10; ++i) {
        const Document document(World{.scene = copy}, options);
        out = bytes_of(document, ".wrl", {.pipeline = "expand,weld,merge", .embed = true});
        out += std::to_string(document.messages().size());
      }
    });
  for (auto& thread : threads) thread.join();
  CHECK(bytes[0].find("FromPart") != std::string::npos);
  for (const auto& other : bytes) CHECK(other == bytes[0]);
}

TEST_CASE("made scene: what another document brings along is found", "[made]") {
  const TempFolder folder;
  folder.write("tree/leaf.png", pixel());
  const auto tree = folder.write("tree/tree.wrl", R"(#VRML V2.0 utf8
DEF Tree Shape { appearance Appearance { texture ImageTexture { url "leaf.png" } } geometry Box { } })");
  const auto plain = folder.write("land/land.wrl", "#VRML V2.0 utf8\nDEF Land Shape { geometry Box { } }");
  for (const bool from_file : {true, false}) {
    CAPTURE(from_file);
    Document land = from_file ? load(plain) : Document(World{});
    const Document other = load(tree);
    REQUIRE(other);
    for (int i = 0; i < 2; ++i) {
      const Scope scope = land.import(other);
      auto& roots = land.scene().main.roots;
      roots.insert(roots.end(), scope.roots.begin(), scope.roots.end());
    }
    const NodeId last = land.scene().main.roots.back();
    CHECK(land.diag().sources().file(land.scene().where(last).begin) == tree);
    CHECK(bytes_of(land, ".glb").find("image/png") != std::string::npos);
    REQUIRE(save(land, folder / "out/all.wrl"));
    CHECK(folder.read("out/all.wrl").find("all_files/") != std::string::npos);
    CHECK(folder.read("out/all_files/leaf.png") == pixel());
  }
}

TEST_CASE("made scene: pictures that passes of another document have made come along", "[made]") {
  Made made;
  auto one = made.document(), two = made.document();
  for (Document* document : {&one, &two}) {
    const auto url = document->resources()->add_made({"light.png", std::make_shared<const std::string>(pixel())});
    Scene& scene = document->scene();
    const NodeId appearance = scene.add(nodes::Appearance), texture = scene.add(nodes::ImageTexture);
    scene.set(made.shape, nodes::shape::appearance, appearance);
    scene.set(appearance, nodes::appearance::texture, texture);
    scene.set(texture, nodes::image_texture::url, url);
  }
  const Scope scope = one.import(two);
  one.scene().main.roots.push_back(scope.roots.at(0));
  CHECK(one.resources()->made().size() == 2);
  CHECK(bytes_of(one, ".wrl").find(made_scheme) == std::string::npos);
  const auto again = bytes_of(one, ".wrl");
  CHECK(again.find("data:image/png") != again.rfind("data:image/png"));
}

namespace {

/// A made scene that is saved in each format, and what was said of it; what was written must be read back without a
/// word.
struct SavedEach {
  std::set<std::string> said;
  std::map<std::string, std::string> bytes;

  explicit SavedEach(const Scene& scene, const SaveOptions& options = {}) {
    for (const std::string ending : {".wrl", ".x3d", ".glb"}) {
      CAPTURE(ending);
      const Document document(World{.scene = scene});
      bytes[ending] = bytes_of(document, ending, options);
      for (const auto& m : document.messages()) said.insert(m.name);
      if (bytes[ending].empty()) continue;
      const auto back = load_bytes(bytes[ending], "back");
      REQUIRE(back);
      for (const auto& m : back.messages())
        if (ending != ".glb" || m.name != "name-changed") CHECK(m.str() == "");  // glTF keeps all names
    }
  }
  bool is_saved() const { return !bytes.at(".wrl").empty() && !bytes.at(".x3d").empty() && !bytes.at(".glb").empty(); }
  bool says(const std::string& name) const { return said.contains(name); }
};

/// Names of what check_values says.
std::set<std::string> checked(const Scene& scene) {
  const Document document(World{.scene = scene});
  check_values(document.scene(), document.diag());
  std::set<std::string> names;
  for (const auto& m : document.messages()) names.insert(m.name);
  return names;
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN(),
                 infinite = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("made scene: what is sound is saved without a word", "[made]") {
  const Made made;
  const SavedEach saved(made.scene);
  CHECK(saved.is_saved());
  CHECK(saved.said.empty());
}

TEST_CASE("made scene: a node below itself is not saved", "[made]") {
  Made made;
  const NodeId below = made.scene.add(nodes::Group);
  made.scene.set(below, nodes::group::children, made.group);
  made.scene.set(made.group, nodes::transform::children, below);
  for (const auto* text : {"", "weld,lod", "expand,merge"}) {
    const SavedEach saved(made.scene, {.pipeline = text});
    CHECK_FALSE(saved.is_saved());
    CHECK(saved.said == std::set<std::string>{"verify"});
    auto document = made.document();
    std::string why;
    CHECK_FALSE(Pipeline::parse(text, why)->run(document.scene(), document.context()));
    CHECK(document.diag().count(Diag::verify) > 0);
  }
}

TEST_CASE("made scene: nodes of another scene, and values of another type, are not saved", "[made]") {
  Made made;
  SECTION("a node that is not there") { made.scene.set(made.group, nodes::transform::children, NodeId{1000}); }
  SECTION("a root that is not there") { made.scene.main.roots.push_back(NodeId{1000}); }
  SECTION("a root that is NULL") { made.scene.main.roots.push_back(NodeId{}); }
  SECTION("a type") { made.scene.set(made.box, made.scene.make(FieldType::SFString, nodes::box::size.slot, "large")); }
  const SavedEach saved(made.scene);
  CHECK_FALSE(saved.is_saved());
  CHECK(saved.said == std::set<std::string>{"verify"});
}

TEST_CASE("made scene: NULL among children is dropped", "[made]") {
  Made made;
  made.scene.set(made.group, nodes::transform::children, std::vector{NodeId{}, made.shape, NodeId{}});
  CHECK(checked(made.scene) == std::set<std::string>{"null-repaired"});
  const SavedEach saved(made.scene);
  CHECK(saved.is_saved());
  CHECK(saved.said == std::set<std::string>{"null-repaired"});
}

TEST_CASE("made scene: numbers that are not finite become 0", "[made]") {
  Made made;
  made.scene.set(made.group, nodes::transform::translation, Vec3{no_number, 1, infinite}, nodes::transform::scale,
                 Vec3{1, 1, -infinite});
  const NodeId faces = made.scene.add(nodes::IndexedFaceSet), coord = made.scene.add(nodes::Coordinate);
  made.scene.set(coord, nodes::coordinate::point, std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, no_number, 0, 0});
  made.scene.set(faces, nodes::indexed_face_set::coord, coord, nodes::indexed_face_set::coordIndex,
                 std::vector<std::int32_t>{0, 1, 2, -1, 0, 2, 3});
  made.scene.set(made.shape, nodes::shape::geometry, faces);
  CHECK(checked(made.scene).contains("not-finite"));
  const SavedEach saved(made.scene);
  CHECK(saved.is_saved());
  CHECK(saved.says("not-finite"));
  for (const auto& [ending, bytes] : saved.bytes) {
    CHECK(bytes.find("nan") == bytes.npos);
    CHECK(bytes.find("inf") == bytes.npos);
  }
}

TEST_CASE("made scene: what passes make is finite when it is written", "[made]") {
  Scene scene;
  const NodeId shape = scene.add(nodes::Transform);
  scene.set(shape, nodes::transform::translation, Vec3{infinite, 0, no_number});
  scene.main.roots = {shape};
  Diagnostics diag;
  std::string text;
  write_vrml(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  CHECK(text.find("translation 0 0 0") != text.npos);
  CHECK(diag.count(Diag::not_finite) == 1);
}

TEST_CASE("made scene: texts that are not UTF-8, with control characters, in names", "[made]") {
  Made made;
  const NodeId text = made.scene.add(nodes::Text), info = made.scene.add(nodes::WorldInfo);
  made.scene.set(made.shape, nodes::shape::geometry, text);
  made.scene.set(text, nodes::text::string, std::vector<std::string_view>{"caf\xe9", "a\n\"b\\"});
  made.scene.set(info, nodes::world_info::title, "\xff\xfe</WorldInfo>");
  made.scene.set_name(made.shape, "caf\xe9");
  made.scene.set_name(made.group, "two words");
  made.scene.set_name(info, "DEF");
  made.scene.main.roots.push_back(info);
  made.scene.comment = "made by hand\n";
  CHECK(checked(made.scene).contains("encoding-repaired"));
  const SavedEach saved(made.scene);
  CHECK(saved.is_saved());
  CHECK(saved.says("encoding-repaired"));
  CHECK(saved.says("name-changed"));
}

TEST_CASE("made scene: images, indices and ROUTEs that go too far", "[made]") {
  Made made;
  const NodeId appearance = made.scene.add(nodes::Appearance), texture = made.scene.add(nodes::PixelTexture);
  made.scene.set(made.shape, nodes::shape::appearance, appearance);
  made.scene.set(appearance, nodes::appearance::texture, texture);
  SECTION("too many pixels") {
    made.scene.set(texture, nodes::pixel_texture::image, std::vector<std::int32_t>{1, 1, 3, 255, 255});
    CHECK(SavedEach(made.scene).says("missing-values"));
  }
  SECTION("no image") {
    made.scene.set(texture, nodes::pixel_texture::image, std::vector<std::int32_t>{-1, 2000000000, 3});
    CHECK(SavedEach(made.scene).says("bad-value"));
  }
  SECTION("events") {
    made.scene.main.routes.push_back({made.group, made.group, "translation_changed", "set translation"});
    CHECK(SavedEach(made.scene).says("unknown-event"));
  }
  SECTION("indices") {
    const NodeId faces = made.scene.add(nodes::IndexedFaceSet), coord = made.scene.add(nodes::Coordinate);
    made.scene.set(coord, nodes::coordinate::point, std::vector{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0});
    made.scene.set(faces, nodes::indexed_face_set::coord, coord, nodes::indexed_face_set::coordIndex,
                   std::vector<std::int32_t>{0, 1, 2, 2000000000, -7, -1, 0, 1, 2});
    made.scene.set(made.shape, nodes::shape::geometry, faces);
    CHECK(SavedEach(made.scene, {.pipeline = "weld,join,lod"}).says("bad-index"));
  }
}

TEST_CASE("made scene: nodes in places that cannot hold them", "[made]") {
  Made made;
  made.scene.set(made.group, nodes::transform::children, std::vector{made.shape, made.box});
  made.scene.set(made.shape, nodes::shape::geometry, made.scene.add(nodes::Material));
  CHECK(checked(made.scene) == std::set<std::string>{"wrong-child"});
  for (const std::string ending : {".wrl", ".x3d", ".glb"})
    for (const auto* pipeline : {"", "weld,join,lod", "expand,merge,flatten"}) {
      const auto document = made.document();
      CHECK_NOTHROW(bytes_of(document, ending, {.pipeline = pipeline}));
    }
}
