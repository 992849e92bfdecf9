// Scenes that programs make: values of fields, passes of their own, and whatever should not be in a scene.
#include <catch2/catch.hpp>

#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "convert/wrlkit.h"
#include "passes/pipeline/pass_info.h"
#include "scenegraph/nodes.h"
#include "scenegraph/verify.h"
#include "tests/unit/made_fixture.h"
#include "tests/unit/temp_folder.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;

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
