// Pipelines: text, options, and that running lazily gives the same meshes as running at once.
#include <catch2/catch.hpp>
#include <set>

#include <atomic>
#include <thread>

#include "parsers/parsers.h"
#include "passes/combine_lightmap/combine_lightmap.h"
#include "passes/lightmap/lightmap.h"
#include "passes/pipeline/pass_info.h"
#include "passes/pipeline/pipeline.h"
#include "passes/subdivide/subdivide.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "writers/vrml/vrml.h"

using namespace wrlkit;

namespace {

std::string canonical(std::string_view text) {
  std::string why;
  auto p = Pipeline::parse(text, why);
  return p ? p->text() : "error: " + why;
}

std::unique_ptr<World> read(const std::string& text, Diagnostics& diag) {
  return parse_world("#VRML V2.0 utf8\n" + text, "test.wrl", {}, diag);
}

std::string text_of(const Scene& scene) {
  Diagnostics diag;
  std::string text;
  write_vrml(
      scene, {}, [&](std::string_view s) { text += s; }, diag);
  return text;
}

std::vector<NodeId> geometries(const Scene& scene) {
  std::vector<NodeId> out;
  for (NodeId n : reachable(scene, scene.main))
    if (scene.is(n, nodes::X3DGeometryNode)) out.push_back(n);
  return out;
}

/// Position and normal of each corner, as single precision has them.
std::vector<float> corners_of(const Mesh& mesh) {
  std::vector<float> out;
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    for (std::size_t k = 0; k < 3; ++k) out.push_back(static_cast<float>(mesh.positions[3 * mesh.corners[c] + k]));
    const float* normal = mesh.normal.present() ? mesh.normal.at(mesh.normal.index[c]) : nullptr;
    for (std::size_t k = 0; k < 3; ++k) out.push_back(normal ? normal[k] : 0);
  }
  return out;
}

struct NameOptions {
  std::string name = "first";
  void fields(auto&& f) { f("name", name, "DEF name of the first root"); }
};

Outcome name_root(Scene& scene, const NameOptions& options, PassContext&) {
  scene.set_name(scene.main.roots.at(0), options.name);
  return Outcome::changed;
}

Outcome name_nothing(Scene&, const NameOptions&, PassContext&) { return Outcome::unchanged; }

}  // namespace

TEST_CASE("pipeline: text and back", "[pipeline]") {
  for (auto& n : named_pipelines()) CHECK(canonical(canonical(n.name)) == canonical(n.name));
  CHECK(canonical("prune , inline{depth=3}") == "prune,inline{depth=3,limit=500000}");
  CHECK(canonical("gltf,prune") == canonical("gltf") + ",prune");
  const std::string merged = "merge{max-draws=500,instanced=false,parts=false,tolerance=0,segments=0,csv=";
  CHECK(canonical(R"(merge{ csv = "a,b}.csv" })") == merged + R"("a,b}.csv"})");
  CHECK(canonical(R"(merge{csv="a \"b\" \\c"})") == merged + R"("a \"b\" \\c"})");
  CHECK(canonical(canonical(R"(merge{csv="a,\"\\{"},prune)")) == merged + R"("a,\"\\{"},prune)");
  CHECK(canonical(R"(merge{csv=5".csv})") == merged + R"("5\".csv"})");
  CHECK(canonical("") == "");
}

TEST_CASE("pipeline: what is wrong with a text", "[pipeline]") {
  CHECK(canonical("polish") == "error: there is no pass 'polish'; wrlkit passes lists them");
  CHECK(canonical("inline{deepness=3}") ==
        "error: pass 'inline' has no option 'deepness'; its options are depth, limit");
  CHECK(canonical("inline{depth=deep}") ==
        "error: pass 'inline' option 'depth': 'deep' is not a valid value: integer at least 0");
  CHECK(canonical("inline{depth=-1}") ==
        "error: pass 'inline' option 'depth': '-1' is not a valid value: integer at least 0");
  CHECK(canonical("lod{min-saving=nan}") ==
        "error: pass 'lod' option 'min-saving': 'nan' is not a valid value: number 0 to 1");
  CHECK(canonical("lod{min-saving=1.01}") ==
        "error: pass 'lod' option 'min-saving': '1.01' is not a valid value: number 0 to 1");
  CHECK(canonical("lightmap{format=bmp}") ==
        "error: pass 'lightmap' option 'format': 'bmp' is not a valid value: png, jpg or webp");
  CHECK(canonical("inline{depth=3") == "error: '}' is missing behind 'inline'");
  CHECK(canonical(R"(merge{csv="a)") == "error: '}' is missing behind 'merge'");
  CHECK(canonical(R"(merge{csv="a"b})") == "error: pass 'merge' option 'csv': a quote is missing");
}

namespace {

std::string names_of(Pipeline& p) {
  std::string out;
  for (const auto& s : p.steps()) out += (out.empty() ? "" : ",") + std::string(s.name);
  return out;
}

std::string completed(const char* text, const char* standard) {
  std::string why;
  auto p = Pipeline::parse(text, why);
  p->complete(standard);
  return names_of(*p);
}

}  // namespace

TEST_CASE("pipeline: what a pass needs is put in front of it", "[pipeline]") {
  CHECK(completed("cull", "vrml") == "lower-vrml1,expand,lower-x3d,cull,combine-lightmap,lower-x3d");
  CHECK(completed("expand,cull", "x3d") == "lower-vrml1,expand,cull,combine-lightmap,keep-colors");
  CHECK(completed("cull", "gltf") ==
        "lower-vrml1,expand,lower-x3d,prune,cull,combine-lightmap,tessellate,normals,triangulate");
  CHECK(completed("inline,expand-protos,cull", "none") == "inline,expand-protos,cull");
  CHECK(completed("expand-protos,inline,cull", "none") == "expand-protos,inline,expand,cull");
  std::string why;
  auto p = Pipeline::parse("prune,merge,tessellate,normals", why);
  p->meet_needs();
  CHECK(names_of(*p) == "prune,expand,merge,tessellate,normals");
  p->meet_needs();
  CHECK(names_of(*p) == "prune,expand,merge,tessellate,normals");
}

TEST_CASE("pipeline: lazily and at once are the same", "[pipeline]") {
  const std::string text =
      "Shape { geometry Sphere { } } Shape { geometry IndexedFaceSet { creaseAngle 1 coord Coordinate { point [ 0 0 0 "
      "1 0 0 1 1 0 0 1 0.1 ] } coordIndex [ 0 1 2 3 ] } }";
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  std::string why;
  auto pipeline = Pipeline::parse("tessellate,normals", why);
  auto lazy = read(text, diag), at_once = read(text, diag);
  auto source = pipeline->run_lazily(lazy->scene, ctx);
  REQUIRE(pipeline->run(at_once->scene, ctx));
  auto nothing = Pipeline::parse("", why);
  auto stored = nothing->run_lazily(at_once->scene, ctx);
  const auto lazy_nodes = geometries(lazy->scene), nodes = geometries(at_once->scene);
  REQUIRE(lazy_nodes.size() == 2);
  REQUIRE(nodes.size() == 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto a = corners_of(source(lazy_nodes[i])), b = corners_of(stored(nodes[i]));
    CHECK(a.size() >= 6 * 6);
    CHECK(a == b);
  }
}

TEST_CASE("pipeline: a pass says that it has changed something exactly when the text is another one", "[pipeline]") {
  const std::string text =
      "PROTO P [ ] { Shape { geometry Sphere { } } } P { } "
      "DEF A Transform { translation 1 0 0 children [ Shape { geometry IndexedFaceSet { coord Coordinate { point "
      "[ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ] } } Group { } ] } "
      "Transform { children Shape { geometry IndexedFaceSet { coord Coordinate { point "
      "[ 0 0 0, 1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 3 -1 ] } } }";
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  std::set<std::string, std::less<>> changing;
  for (auto& p : passes()) {
    if (p.make()->is_mesh_pass()) continue;
    auto world = read(text, diag);
    const auto before = text_of(world->scene);
    const auto outcome = p.make()->run(world->scene, ctx);
    INFO(p.name);
    CHECK(outcome == (text_of(world->scene) == before ? Outcome::unchanged : Outcome::changed));
    if (outcome == Outcome::changed) changing.emplace(p.name);
  }
  for (const char* name : {"expand-protos", "dedup"}) CHECK(changing.contains(name));
}

TEST_CASE("pipeline: a pass that changes nothing says so and changes nothing", "[pipeline]") {
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  for (auto& p : passes()) {
    if (p.make()->is_mesh_pass()) continue;
    auto world = read("DEF A Transform { children Shape { geometry Box { } } }", diag);
    const auto before = text_of(world->scene);
    auto outcome = p.make()->run(world->scene, ctx);
    INFO(p.name);
    CHECK(outcome == Outcome::unchanged);
    CHECK(before == text_of(world->scene));
  }
}

TEST_CASE("pipeline: times are those of the run whose meshes are written", "[pipeline]") {
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  std::string why;
  auto pipeline = Pipeline::parse("prune,tessellate,normals", why);
  auto world = read("Shape { geometry Sphere { } } Shape { geometry Cone { } }", diag);
  std::vector<PassTime> times;
  const auto source = pipeline->run_lazily(world->scene, ctx, {.times = &times});
  REQUIRE(times.size() == 3);
  CHECK(times[1].name == "tessellate");
  CHECK(times[1].seconds == 0);
  CHECK(stats["tessellate.shapes"] == 0);
  double before = 0;
  for (NodeId n : geometries(world->scene)) {
    source(n);
    CHECK(times[1].seconds > before);
    before = times[1].seconds;
  }
  CHECK(stats["tessellate.shapes"] == 2);  // once each, not on a copy as well
  CHECK(times.size() == 3);
}

TEST_CASE("pipeline: what makes meshes says how finely", "[pipeline]") {
  for (const char* name : {"tessellate", "merge", "flatten", "cull", "lod", "lightmap"}) {
    INFO(name);
    const auto text = canonical(std::string(name) + "{segments=7}");
    CHECK(text.find("tolerance=0,segments=7") != std::string::npos);
  }
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  std::string why;
  for (int segments : {8, 20}) {
    auto world = read("DEF A Transform { translation 1 0 0 children Shape { geometry Cylinder { } } }", diag);
    auto pipeline = Pipeline::parse("flatten{segments=" + std::to_string(segments) + "}", why);
    REQUIRE(pipeline->run(world->scene, ctx));
    auto reading = Pipeline::parse("", why);
    const auto meshes = reading->run_lazily(world->scene, ctx);
    CHECK(meshes(geometries(world->scene).at(0)).n_faces() == static_cast<std::size_t>(segments) + 2);
  }
}

TEST_CASE("pipeline: an option that is one of several names has one row", "[pipeline]") {
  CHECK(choice_type<SubdivisionScheme>() == "loop or catmull-clark");
  CHECK(choice_type<PictureFormat>() == "png, jpg or webp");
  CHECK(name_of(CombinedFormat::as_light) == "auto");
  BakeQuality quality{};
  CHECK(read_choice("high", quality));
  CHECK(quality == BakeQuality::high);
  CHECK_FALSE(read_choice("highest", quality));
  CHECK(choice_help<SubdivisionScheme>("what") ==
        "what: loop, triangles; polygons are triangulated first; catmull-clark, quadrilaterals");
  CHECK(choice_help<BakeQuality>("how") == "how");
  // In every pass each of the names is read and comes back.
  for (const auto& p : passes())
    for (const auto& option : p.make()->options()) {
      const auto last = option.type.rfind(" or ");
      if (last == std::string::npos || option.type.find_first_of(":=") != std::string::npos) continue;
      const auto name = option.type.substr(last + 4);
      if (name == "auto" || name == "webp" || name == "r") continue;
      INFO(p.name << " " << option.name << " " << name);
      CHECK(canonical(std::string(p.name) + "{" + option.name + "=" + name + "}").find(option.name + "=" + name) !=
            std::string::npos);
    }
}

TEST_CASE("pipeline: passes that a program adds", "[pipeline]") {
  constexpr auto naming = pass<name_root, NameOptions>("test-name", "name a root", Level::authored, Level::authored);
  constexpr auto taken = pass<name_root, NameOptions>("weld", "a name that is taken", Level::authored, Level::authored);
  CHECK_FALSE(add_pass(taken));
  REQUIRE(add_pass(naming));
  std::string why;
  auto pipeline = Pipeline::parse("prune,test-name{name=A}", why);
  REQUIRE(pipeline);
  CHECK(pipeline->text() == "prune,test-name{name=A}");

  // A pipeline keeps the pass that it was made with.
  REQUIRE(add_pass(pass<name_nothing, NameOptions>("test-name", "another", Level::authored, Level::authored)));
  CHECK(find_pass("test-name")->summary == "another");
  CHECK(pipeline->text() == "prune,test-name{name=A}");
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  auto world = read("Group { children Shape { geometry Box { } } }", diag);
  REQUIRE(pipeline->run(world->scene, ctx));
  CHECK(world->scene.name(world->scene.main.roots.at(0)) == "A");
}

TEST_CASE("pipeline: passes are added and found by several threads", "[pipeline]") {
  std::vector<std::thread> threads;
  std::atomic<int> found = 0;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&found, t] {
      for (int i = 0; i < 200; ++i) {
        static const std::string names[] = {"test-a", "test-b", "test-c", "test-d"};
        add_pass(pass<name_nothing, NameOptions>(names[t], "of one thread", Level::authored, Level::authored));
        if (find_pass(names[t])) ++found;
      }
    });
  for (auto& t : threads) t.join();
  CHECK(found == 800);
}
