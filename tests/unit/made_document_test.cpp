// Documents of bytes and of scenes that programs make: what they may read, and what saving them to memory gives.
#include <catch2/catch.hpp>

#include <stdexcept>
#include <thread>

#include "convert/wrlkit.h"
#include "scenegraph/nodes.h"
#include "tests/unit/made_fixture.h"
#include "tests/unit/temp_folder.h"

using namespace wrlkit;

TEST_CASE("made document: bytes have no folder, so nothing is read that was not allowed", "[made]") {
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

TEST_CASE("made document: urls of bytes are looked for below the folders that are allowed", "[made]") {
  const Parts parts;
  const TempFolder elsewhere;
  const InFolder in(elsewhere.path());
  const auto document = load_bytes(refers, "bytes.wrl", {.allow_paths = {parts.folder.path()}});
  const auto bytes = bytes_of(document, ".wrl", {.pipeline = "expand", .embed = true});
  CHECK(bytes.find("FromPart") != bytes.npos);
  CHECK(bytes.find("FromKept") != bytes.npos);
  CHECK(bytes.find("data:image/png;base64") != bytes.npos);
}

TEST_CASE("made document: buffers of glTF bytes are looked for below the folders that are allowed", "[made]") {
  Made made;
  const TempFolder folder;
  REQUIRE(save(made.document(), folder / "box.gltf", {.extras = Extras::none}));
  const auto text = folder.read("box.gltf");
  const InFolder in(folder.path());
  CHECK(has_message(load_bytes(text, "box.gltf"), "url-not-found"));
  CHECK(load_bytes(text, "box.gltf", {.allow_paths = {folder.path()}}).messages().empty());
}

TEST_CASE("made document: pictures of a scene that a program makes", "[made]") {
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

TEST_CASE("made document: urls of nodes that lie in no file lead to the files that they mean", "[made]") {
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

TEST_CASE("made document: what a Sink throws comes out of save", "[made]") {
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

TEST_CASE("made document: what a Monitor throws comes out, and leaves no file", "[made]") {
  const TempFolder folder;
  folder.write("box.wrl", "#VRML V2.0 utf8\nShape { geometry Box { } }");
  ThrowingMonitor monitor;
  CHECK_THROWS_AS(convert(folder / "box.wrl", folder / "box.glb", {}, {&monitor}), std::runtime_error);
  CHECK(folder.file_count() == 1);
}

TEST_CASE("made document: baked light is in what is saved to memory, the same each time", "[made][bake]") {
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

TEST_CASE("made document: copies of a scene do not add to its memory, and may be worked on by threads", "[made]") {
  Made made;
  Scene copy = made.scene;
  CHECK(&copy.arena() != &made.scene.arena());
  const auto name = copy.keep("kept");
  made.scene = copy;
  CHECK(name == "kept");
}

TEST_CASE("made document: documents of copies are worked on in several threads", "[made]") {
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

TEST_CASE("made document: what another document brings along is found", "[made]") {
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

TEST_CASE("made document: pictures that passes of another document have made come along", "[made]") {
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
