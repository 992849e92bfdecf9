// Pipelines: text, options, and that running lazily gives the same meshes as running at once.
#include <catch2/catch.hpp>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
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

}  // namespace

TEST_CASE("pipeline: text and back", "[pipeline]") {
  for (auto& n : named_pipelines()) CHECK(canonical(canonical(n.name)) == canonical(n.name));
  CHECK(canonical("prune , inline{depth=3}") == "prune,inline{depth=3,limit=500000}");
  CHECK(canonical("gltf,prune") == canonical("gltf") + ",prune");
  const std::string merged = "merge{max-draws=500,instanced=false,parts=false,csv=";
  CHECK(canonical(R"(merge{ csv = "a,b}.csv" })") == merged + R"("a,b}.csv"})");
  CHECK(canonical(R"(merge{csv="a \"b\" \\c"})") == merged + R"("a \"b\" \\c"})");
  CHECK(canonical(canonical(R"(merge{csv="a,\"\\{"},prune)")) == merged + R"("a,\"\\{"},prune)");
  CHECK(canonical(R"(merge{csv=5".csv})") == merged + R"("5\".csv"})");
  CHECK(canonical("") == "");
}

TEST_CASE("pipeline: what is wrong with a text", "[pipeline]") {
  CHECK(canonical("polish") == "error: there is no pass 'polish'");
  CHECK(canonical("inline{deepness=3}") == "error: pass 'inline' has no option 'deepness'");
  CHECK(canonical("inline{depth=deep}") ==
        "error: pass 'inline' option 'depth': 'deep' is no value for it: integer at least 0");
  CHECK(canonical("inline{depth=-1}") ==
        "error: pass 'inline' option 'depth': '-1' is no value for it: integer at least 0");
  CHECK(canonical("lod{min-saving=nan}") ==
        "error: pass 'lod' option 'min-saving': 'nan' is no value for it: number 0 to 1");
  CHECK(canonical("lod{min-saving=1.01}") ==
        "error: pass 'lod' option 'min-saving': '1.01' is no value for it: number 0 to 1");
  CHECK(canonical("lightmap{format=bmp}") ==
        "error: pass 'lightmap' option 'format': 'bmp' is no value for it: png, jpg or webp");
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
  CHECK(completed("expand,cull", "x3d") == "lower-vrml1,expand,combine-lightmap,keep-colors,cull");
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
  for (NodeId n : all_nodes(lazy->scene)) {
    if (!lazy->scene.type(n).is_a("X3DGeometryNode")) continue;
    auto count = source(n).corners.size();
    CHECK(count > 0);
    CHECK(stored(n).corners.size() == count);
    CHECK(stored(n).normal.present());
  }
}

TEST_CASE("pipeline: a pass that changes nothing says so and changes nothing", "[pipeline]") {
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  for (auto& p : passes()) {
    if (p.make()->is_mesh_pass()) continue;
    auto world = read("DEF A Transform { children Shape { geometry Box { } } }", diag);
    std::string before, after;
    write_vrml(
        world->scene, {}, [&](std::string_view s) { before += s; }, diag);
    auto outcome = p.make()->run(world->scene, ctx);
    write_vrml(
        world->scene, {}, [&](std::string_view s) { after += s; }, diag);
    INFO(p.name);
    CHECK(outcome == Outcome::unchanged);
    CHECK(before == after);
  }
}
