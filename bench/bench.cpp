// The stages of the main road on one thread, in bytes of VRML text a CPU second, and the floor: a bare fast_float
// loop that finds the numbers of the same text and stores them.
//   wrlkit_bench FILE.wrl [--benchmark_...]
#include <benchmark/benchmark.h>
#include <fast_float/fast_float.h>

#include <cstdio>
#include <string>
#include <vector>

#include "geometry/geometry.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "passes/weld/weld.h"
#include "scenegraph/nodes.h"
#include "writers/gltf/gltf.h"
#include "writers/vrml/vrml.h"

namespace {

using namespace wrlkit;

std::string path, text;

void count(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
}

bool blank(char c) { return c == ' ' || c == ',' || c == '\n' || c == '\r' || c == '\t'; }

void floor_floats(benchmark::State& state) {
  for (auto _ : state) {
    std::vector<float> numbers;
    numbers.reserve(text.size() / 7);
    for (const char *p = text.data(), *end = p + text.size(); p < end;) {
      while (p < end && blank(*p)) ++p;
      float f;
      bool number = p < end && ((*p >= '0' && *p <= '9') || *p == '-' || *p == '.');
      auto r =
          number ? fast_float::from_chars(p, end, f) : fast_float::from_chars_result{p, std::errc::invalid_argument};
      if (r.ec != std::errc{}) {
        while (p < end && !blank(*p)) ++p;
        continue;
      }
      numbers.push_back(f);
      p = r.ptr;
    }
    benchmark::DoNotOptimize(numbers.data());
  }
  count(state);
}
BENCHMARK(floor_floats)->Unit(benchmark::kMillisecond);

std::unique_ptr<World> read() {
  Diagnostics diag;
  return parse_world(text, path, {}, diag);
}

void parse(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(read());
  count(state);
}
BENCHMARK(parse)->Unit(benchmark::kMillisecond);

void write_vrml_text(benchmark::State& state) {
  auto world = read();
  Diagnostics diag;
  std::size_t bytes = 0;
  for (auto _ : state)
    write_vrml(
        world->scene, {}, [&](std::string_view s) { bytes += s.size(); }, diag);
  benchmark::DoNotOptimize(bytes);
  count(state);
}
BENCHMARK(write_vrml_text)->Unit(benchmark::kMillisecond);

/// Every mesh through tessellate, normals, triangulate; nothing is written.
void meshes(benchmark::State& state) {
  auto world = read();
  std::string why;
  auto pipeline = Pipeline::parse("tessellate{triangles=false},normals,triangulate", why);
  for (auto _ : state) {
    Diagnostics diag;
    Statistics stats;
    PassContext ctx{diag, stats};
    auto source = pipeline->run_lazily(world->scene, ctx);
    std::size_t corners = 0;
    for (std::uint32_t i = 0; i < world->scene.node_count(); ++i)
      if (world->scene.is(NodeId{i}, nodes::X3DGeometryNode)) corners += source(NodeId{i}).corners.size();
    benchmark::DoNotOptimize(corners);
  }
  count(state);
}
BENCHMARK(meshes)->Unit(benchmark::kMillisecond);

/// The pass alone, in corners: the meshes are read before.
void weld_points(benchmark::State& state, const char* tolerance) {
  auto world = read();
  const Scene& scene = world->scene;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  MeshScratch scratch;
  std::vector<Mesh> meshes;
  std::size_t corners = 0;
  for (std::uint32_t i = 0; i < scene.node_count(); ++i) {
    MeshJob job{scene, NodeId{i}, meshes.emplace_back(), scratch, ctx};
    read_mesh(job);
    corners += meshes.back().corners.size();
  }
  WeldOptions options;
  options.tolerance.read(tolerance);
  for (auto _ : state) {
    state.PauseTiming();
    auto welded = meshes;
    state.ResumeTiming();
    for (std::uint32_t i = 0; i < welded.size(); ++i) {
      MeshJob job{scene, NodeId{i}, welded[i], scratch, ctx};
      weld(job, options);
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * corners));
}
BENCHMARK_CAPTURE(weld_points, exact, "0")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(weld_points, auto, "auto") -> Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(weld_points, tolerance, "0.001")->Unit(benchmark::kMillisecond);

void to_glb(benchmark::State& state) {
  std::string why;
  auto pipeline = Pipeline::parse("gltf", why);
  for (auto _ : state) {
    auto world = read();
    Diagnostics diag;
    Statistics stats;
    PassContext ctx{diag, stats};
    auto source = pipeline->run_lazily(world->scene, ctx);
    write_gltf(world->scene, source, {}, nullptr, "/dev/null", diag);
  }
  count(state);
}
BENCHMARK(to_glb)->Unit(benchmark::kMillisecond);

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: wrlkit_bench FILE.wrl [--benchmark_...]\n");
    return 2;
  }
  path = argv[1];
  Diagnostics diag;
  auto file = read_file(path, {}, diag);
  if (!file) {
    std::fprintf(stderr, "%s cannot be read\n", argv[1]);
    return 1;
  }
  text = file->view();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
