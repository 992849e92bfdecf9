// `weld` over whole worlds: what it must keep, and that loose faces get the topology of the same world with shared points.
#include <catch2/catch.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "parsers/parsers.h"
#include "passes/geometry.h"
#include "passes/pipeline.h"
#include "passes/triangulate.h"
#include "passes/weld.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

using namespace wrlkit;

namespace {

namespace fs = std::filesystem;

const fs::path source = WRLKIT_SOURCE_DIR;

/// A world at level mesh, polygons uncut.
struct Meshes {
  std::unique_ptr<World> world;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  MeshScratch scratch;

  explicit Meshes(const fs::path& path, const std::string& passes = "inline,expand-protos,inline,expand-protos,tessellate{triangles=false}") {
    world = read_world(path.string(), {}, diag);
    if (world) run(passes);
  }
  void run(const std::string& passes) {
    std::string why;
    {
      auto p = Pipeline::parse(passes, why);
      INFO(why);
      REQUIRE(p);
      REQUIRE(p->run(world->scene, ctx));
    }
  }
  std::vector<NodeId> geometries() const {
    std::vector<NodeId> out;
    for (NodeId n : reachable(world->scene, world->scene.main))
      if (world->scene.is(n, nodes::IndexedFaceSet)) out.push_back(n);
    return out;
  }
  Mesh read(NodeId n) {
    Mesh mesh;
    MeshJob job{world->scene, n, mesh, scratch, ctx};
    read_mesh(job);
    return mesh;
  }
  template <class Pass, class Options>
  Outcome apply(Pass pass, Mesh& mesh, const Options& options) {
    MeshJob job{world->scene, NodeId{0}, mesh, scratch, ctx};
    return pass(job, options);
  }
};

using Box = std::array<double, 6>;

Box bounds(const Mesh& mesh) {
  Box b{1e300, 1e300, 1e300, -1e300, -1e300, -1e300};
  for (auto p : mesh.corners)
    for (std::size_t i = 0; i < 3; ++i) {
      b[i] = std::min(b[i], mesh.positions[3 * std::size_t{p} + i]);
      b[3 + i] = std::max(b[3 + i], mesh.positions[3 * std::size_t{p} + i]);
    }
  return b;
}

void check_valid(const Mesh& mesh) {
  if (!mesh.face_begin.empty()) {
    REQUIRE(std::ranges::is_sorted(mesh.face_begin));
    REQUIRE(mesh.face_begin.back() == mesh.corners.size());
  }
  for (auto c : mesh.corners) REQUIRE(c < mesh.n_positions());
  for (const Attribute* a : {&mesh.normal, &mesh.color, &mesh.texcoord}) {
    if (!a->present()) continue;
    REQUIRE(a->index.size() == mesh.corners.size());
    for (auto i : a->index) REQUIRE(i < a->count());
  }
}

std::size_t triangles(Meshes& m, Mesh mesh) {
  m.apply(triangulate, mesh, TriangulateOptions{});
  return mesh.n_faces();
}

std::vector<fs::path> worlds() {
  std::vector<fs::path> out;
  const char* shared = std::getenv("WRLKIT_SHARED");
  for (fs::path folder : {source / "corpus", (shared ? fs::path(shared) : source.parent_path() / "shared") / "corpus"}) {
    if (!fs::is_directory(folder)) continue;
    for (auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace

TEST_CASE("weld keeps triangles and bounds of every world") {
  std::size_t n = 0;
  for (const auto& path : worlds()) {
    INFO(path.string());
    Meshes m(path);
    if (!m.world || m.world->format != Format::vrml97) continue;
    ++n;
    for (NodeId g : m.geometries()) {
      Mesh before = m.read(g), after = before;
      m.stats.clear();
      m.apply(weld, after, WeldOptions{});
      check_valid(after);
      auto removed = m.stats["weld.duplicate-triangles"], added = m.stats["weld.t-junctions"];
      if (triangles(m, before) + added != triangles(m, after) + removed || bounds(before) != bounds(after)) {
        std::printf("%s node %u: %zu -> %zu, dup %zu tj %zu deg %zu rep %zu; %s\n", path.c_str(), g.value, triangles(m, before), triangles(m, after), removed, added, m.stats["weld.degenerate-faces"], m.stats["weld.repeated-corners"], bounds(before) == bounds(after) ? "" : "bounds");
      }
      Mesh again = after;
      if (m.apply(weld, again, WeldOptions{}) != Outcome::unchanged)  { std::printf("%s node %u: again\n", path.c_str(), g.value);}
    }
  }
  std::printf("%zu\n", n);
}
