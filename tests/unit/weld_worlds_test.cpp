// `weld` over whole worlds: what it must keep, and that loose faces get the topology of the same world with shared
// points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <string>

#include "base/math/vec.h"
#include "geometry/geometry.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "passes/triangulate/triangulate.h"
#include "passes/weld/weld.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tests/unit/folders.h"
#include "tests/unit/skip.h"
#include "tests/unit/temp_folder.h"

using namespace wrlkit;

namespace {

namespace fs = std::filesystem;

/// A world at level mesh, polygons uncut.
struct Meshes {
  std::unique_ptr<World> world;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  MeshScratch scratch;

  explicit Meshes(const fs::path& path, const std::string& passes = "expand,tessellate{triangles=false}") {
    world = read_world(path.string(), {}, diag);
    if (world) run(passes);
  }
  void run(const std::string& passes) {
    std::string why;
    auto p = Pipeline::parse(passes, why);
    INFO(why);
    REQUIRE(p);
    REQUIRE(p->run(world->scene, ctx));
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
  auto below = [](const std::vector<std::uint32_t>& index, std::size_t n) {
    return std::ranges::all_of(index, [n](auto i) { return i < n; });
  };
  REQUIRE(below(mesh.corners, mesh.n_positions()));
  for (const Attribute* a : mesh.attributes()) {
    if (!a->present()) continue;
    REQUIRE(a->index.size() == mesh.corners.size());
    REQUIRE(below(a->index, a->count()));
  }
}

double area(Meshes& m, Mesh mesh) {
  m.apply(triangulate, mesh, TriangulateOptions{});
  double sum = 0;
  for (std::size_t c = 0; c < mesh.corners.size(); c += 3) {
    Vec3 p[3];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) p[i][k] = mesh.positions[3 * std::size_t{mesh.corners[c + i]} + k];
    sum += length(cross(p[1] - p[0], p[2] - p[0])) / 2;
  }
  return sum;
}

std::size_t triangles(Meshes& m, Mesh mesh) {
  m.apply(triangulate, mesh, TriangulateOptions{});
  return mesh.n_faces();
}

std::vector<fs::path> worlds(const std::vector<fs::path>& folders) {
  std::vector<fs::path> out;
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) continue;
    for (auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) out.push_back(entry.path());
  }
  std::ranges::sort(out);
  return out;
}

}  // namespace

TEST_CASE("weld keeps triangles and bounds of every world") {
  std::size_t n_worlds = 0;
  for (const auto& path : worlds({source_folder() / "corpus", shared_folder("corpus")})) {
    INFO(path.string());
    Meshes m(path);
    if (!m.world || m.world->format != Format::vrml97) continue;
    ++n_worlds;
    for (NodeId g : m.geometries()) {
      Mesh before = m.read(g), after = before;
      m.stats.clear();
      m.apply(weld, after, WeldOptions{});
      check_valid(after);
      REQUIRE(bounds(after) == bounds(before));
      // A corner more is a triangle more, but where a face crosses itself.
      auto n = triangles(m, before) - m.stats["weld.duplicate-triangles"], n_after = triangles(m, after);
      REQUIRE(n_after >= n);
      REQUIRE(n_after <= n + m.stats["weld.t-junctions"]);
      REQUIRE(m.apply(weld, after, WeldOptions{}) == Outcome::unchanged);
      const double area_before = area(m, after);
      WeldOptions merging;
      merging.merge_coplanar = true;
      m.apply(weld, after, merging);
      check_valid(after);
      REQUIRE(area(m, after) == Approx(area_before).epsilon(1e-4));
    }
  }
  REQUIRE(n_worlds > 150);
}

namespace {

struct Topology {
  std::size_t points, edges, faces;
  auto operator<=>(const Topology&) const = default;
};

Topology topology(Meshes& m, NodeId n) {
  Mesh mesh = m.read(n);
  m.apply(triangulate, mesh, TriangulateOptions{});
  std::set<std::uint32_t> points(mesh.corners.begin(), mesh.corners.end());
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    edges.insert(std::minmax(mesh.corners[c], mesh.corners[c % 3 == 2 ? c - 2 : c + 1]));
  return {points.size(), edges.size(), mesh.n_faces()};
}

/// One for each Shape of the world, in the order of the file.
std::vector<Topology> topologies(Meshes& m) {
  std::vector<Topology> out;
  const Scene& scene = m.world->scene;
  for (NodeId n : reachable(scene, scene.main))
    if (scene.is(n, nodes::Shape)) out.push_back(topology(m, scene.get(n, nodes::shape::geometry)));
  return out;
}

}  // namespace

TEST_CASE("welded loose faces have the topology of shared points, part by part") {
  const fs::path folder = source_folder() / "corpus" / "plant";
  Meshes faces(folder / "pump_room_faces.wrl"), loose(folder / "pump_room_loose.wrl");
  auto shared = topologies(faces);
  loose.run("weld");
  faces.run("weld");
  auto want = topologies(faces), have = topologies(loose);
  REQUIRE(want.size() == 135);
  REQUIRE(have == want);
  // Bodies in one Shape that touch have points of their own in the file, and are joined where they touch.
  std::size_t n_same = 0;
  for (std::size_t i = 0; i < want.size(); ++i) n_same += want[i] == shared[i];
  REQUIRE(n_same == 128);
}

TEST_CASE("a generated plant as a soup of faces gets the topology of the indexed one, part by part", "[found]") {
  const fs::path generator = shared_folder("bench") / "gen_plant.py";
  if (!fs::exists(generator)) {
    return skip("there is no " + generator.string());
  }
  TempFolder folder;
  auto generate = [&](const std::string& name, const std::string& options) {
    auto path = folder.path() / name;
    auto command = "python3 " + generator.string() + " " + path.string() + " --size 1500k " + options + " >/dev/null";
    REQUIRE(std::system(command.c_str()) == 0);
    return path;
  };
  Meshes faces(generate("faces.wrl", "")), soup(generate("soup.wrl", "--soup"));
  soup.run("weld");
  auto want = topologies(faces), have = topologies(soup);
  want.resize(std::min(want.size(), have.size()));  // the soup takes more bytes, so there is less of the same plant
  have.resize(want.size());
  REQUIRE(want.size() > 300);
  REQUIRE(have == want);
}

TEST_CASE("join keeps the triangles of every world, and finds nothing more when run again") {
  auto total = [](Meshes& m) {
    std::size_t n = 0;
    for (NodeId g : m.geometries()) n += triangles(m, m.read(g));
    return n;
  };
  std::size_t n_joined = 0;
  for (const auto& path : worlds({source_folder() / "corpus"})) {
    INFO(path.string());
    Meshes m(path);
    if (!m.world || m.world->format != Format::vrml97) continue;
    auto before = total(m);
    m.run("join");
    REQUIRE(total(m) == before);
    auto n = m.stats["join.shapes"];
    m.run("join");
    REQUIRE(m.stats["join.shapes"] == n);
    n_joined += n;
  }
  REQUIRE(n_joined > 0);
}
