// The door for C++ programs: convert/.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>

#include "convert/wrlkit.h"
#include "scenegraph/nodes.h"
#include "tests/unit/folders.h"

using namespace wrlkit;

namespace {

namespace fs = std::filesystem;

std::string corpus(const std::string& name) { return (source_folder() / "corpus" / name).string(); }

/// A folder that is gone behind the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("wrlkit_convert_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string operator/(const std::string& name) const { return (path / name).string(); }
};

std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Stops the work at its nth step.
class StopsAt final : public Monitor {
 public:
  StopsAt(std::stop_source source, int steps) : source_(std::move(source)), steps_(steps) {}
  void begin(std::string, std::uint64_t, std::string) override {}
  void step(std::uint64_t) override {
    if (--steps_ == 0) source_.request_stop();
  }

 private:
  std::stop_source source_;
  int steps_;
};

}  // namespace

TEST_CASE("convert: a file is loaded, and saved in every format that is written") {
  const Folder out;
  const Document document = load(corpus("plant/pump_room_faces.wrl"));
  REQUIRE(document);
  CHECK(document.world().format == Format::vrml97);
  const auto n_nodes = document.scene().node_count();
  for (auto ending : output_endings()) {
    const auto path = out / ("pump" + std::string(ending));
    const auto saved = save(document, path);
    CHECK(saved.ending == Ending::good);
    const auto bytes = contents(path);
    REQUIRE(bytes.size() > 1000);
    CHECK((bytes.substr(0, 2) == "\x1f\x8b") == is_packed_ending(ending));
    CHECK(load(path));
  }
  CHECK(document.scene().node_count() == n_nodes);  // saving leaves the document as it is
}

TEST_CASE("convert: memory and file hold the same .glb") {
  const Folder out;
  const Document document = load(corpus("plant/pump_room_faces.wrl"));
  SaveOptions small{.compress = GltfCompression::Method::meshopt};
  small.tolerance.metres = 0.001;
  std::string bytes;
  REQUIRE(save(
      document, [&](std::string_view piece) { bytes += piece; }, ".glb", small));
  const auto saved = save(document, out / "pump.glb", small);
  REQUIRE(saved);
  CHECK(bytes == contents(out / "pump.glb"));
  CHECK(saved.gltf->triangles == 29836);
  CHECK(saved.gltf->quantization.position <= 0.001);
}

TEST_CASE("convert: bytes are read in metres with Y up") {
  const auto document =
      load_bytes("#VRML V2.0 utf8\nShape { geometry Box { } }\n", "box.wrl", {.unit = Unit::mm, .up = UpAxis::z});
  REQUIRE(document);
  const auto& scene = document.scene();
  REQUIRE(scene.main.roots.size() == 1);
  CHECK(scene.get(scene.main.roots[0], nodes::transform::scale)[0] == 0.001);
  CHECK(scene.get(scene.main.roots[0], nodes::transform::rotation)[0] == 1);
}

TEST_CASE("convert: errors are values with places") {
  const auto nothing = load("no/such/file.wrl");
  CHECK(!nothing);
  REQUIRE(nothing.messages().size() == 1);
  CHECK(nothing.messages()[0].severity == Severity::error);

  const auto faulty = load_bytes("#VRML V2.0 utf8\nShape {\n  geometry Bax { }\n}\n", "faulty.wrl");
  REQUIRE(faulty);
  REQUIRE(!faulty.messages().empty());
  const auto message = faulty.messages()[0];
  CHECK(message.name == "unknown-node");
  CHECK(message.file == "faulty.wrl");
  CHECK(message.line == 3);
  CHECK(message.str().starts_with("faulty.wrl:3:"));

  const auto saved = save(faulty, "faulty.obj");
  CHECK(!saved);
  CHECK(faulty.messages().back().text.find(".wrl, .x3d, .gltf or .glb") != std::string::npos);
  CHECK(!save(faulty, "faulty.glb", {.pipeline = "weeld"}));
  CHECK(faulty.messages().back().text.find("did you mean 'weld'") != std::string::npos);
  CHECK(!fs::exists("faulty.glb"));

  const auto strict = load_bytes("#VRML V2.0 utf8\nShape { colour 1 }\n", "strict.wrl", {.strict = true});
  CHECK(strict.diag().has_errors());
}

TEST_CASE("convert: from file to file, with all that was reported") {
  const Folder out;
  const auto done = convert(corpus("plant/pump_room_faces.wrl"), out / "pump.wrl", {.save = {.precision = 3}});
  CHECK(done.ending == Ending::good);
  CHECK(contents(out / "pump.wrl").starts_with("#VRML V2.0 utf8"));
  const auto failed = convert("no/such/file.wrl", out / "no.glb");
  CHECK(failed.ending == Ending::failed);
  CHECK(failed.messages.size() == 1);
  CHECK(!fs::exists(out / "no.glb"));
}

TEST_CASE("convert: work ends when it is stopped, and leaves no file") {
  const Folder out;
  for (const int steps : {1, 100}) {  // shapes that are written before
    std::stop_source source;
    StopsAt watcher(source, steps);
    const auto path = out / "stopped.glb";
    const auto done = convert(corpus("plant/pump_room_faces.wrl"), path, {}, {&watcher, source.get_token()});
    CHECK(done.ending == Ending::stopped);
    CHECK(!fs::exists(path));
  }
  std::stop_source before;
  before.request_stop();
  const auto text =
      convert(corpus("plant/pump_room_faces.wrl"), out / "stopped.wrl", {}, {nullptr, before.get_token()});
  CHECK(text.ending == Ending::stopped);
  CHECK(!fs::exists(out / "stopped.wrl"));
}

TEST_CASE("convert: the table of formats is whole") {
  std::set<std::string_view> names;
  for (const auto& format : formats()) {
    CHECK(names.insert(format.name).second);
    CHECK((format.write != nullptr) == (format.pipeline != nullptr));
    if (!format.write) continue;
    for (auto ending : endings_of(format)) {
      const auto to = output_of("a" + std::string(ending));
      REQUIRE(to);
      CHECK(to->format == &format);
      CHECK(to->gzip == is_packed_ending(ending));
    }
  }
  CHECK(output_of("PUMP.GLB"));
  CHECK(output_of("-")->format->name == "GLB");
  CHECK(!output_of("pump.obj"));
  CHECK(!output_of("pump.glb.gz"));
  CHECK(output_of("pump.wrl", {.gzip = true})->gzip);
  CHECK(ending_of("plant.wrl.gz", scene_endings()) == ".wrl.gz");
  for (auto f : {Format::vrml1, Format::vrml97, Format::x3d_classic, Format::x3d_xml, Format::gltf})
    CHECK(std::ranges::any_of(formats(), [&](const FileFormat& row) { return row.parsed == f; }));
}

TEST_CASE("convert: options describe themselves") {
  std::set<std::string_view> names;
  SaveOptions save;
  LoadOptions load;
  const auto once = [&](std::string_view name, auto&, std::string_view help, OptionNote = {}) {
    CHECK(names.insert(name).second);
    CHECK(!help.empty());
  };
  save.fields(once);
  load.fields(once);
  CHECK(names.contains("texture-size"));
  CHECK(name_of(GltfCompression::Method::meshopt) == "meshopt");
}

TEST_CASE("convert: what is inside, what differs, what is small, what is lit") {
  const Folder out;
  const Document document = load(corpus("plant/pump_room_faces.wrl"));
  REQUIRE(document);
  const auto facts = info(document);
  REQUIRE(facts);
  CHECK(facts->geometry.shapes == 623);
  CHECK(facts->geometry.triangles == 29836);
  CHECK(facts->nodes.at("Viewpoint") == 4);
  CHECK(!info(Document()));

  const auto small = optimize(document, out / "small.glb");
  REQUIRE(small);
  CHECK(small.n_names == 239);
  CHECK(small.lost.empty());
  CHECK(!optimize(document, out / "small.wrl"));

  const auto d = diff(document, load(out / "small.glb"));
  REQUIRE(d);
  CHECK(d->missing.empty());
  CHECK(d->surface->max < 0.01);

  auto lit = load_bytes(
      "#VRML V2.0 utf8\nPointLight { location 0 3 0 }\n"
      "Shape { appearance Appearance { material Material { } } geometry Box { } }\n",
      "lit.wrl");
  REQUIRE(bake(lit, {.quality = BakeQuality::draft}) == Ending::good);
  REQUIRE(save(lit, out / "lit.wrl"));
  std::size_t n_files = 0;
  for (const auto& file : fs::directory_iterator(out.path))
    n_files += file.path().string().find("lit.") != std::string::npos;
  CHECK(n_files > 1);  // the world, and the picture of its light
}
