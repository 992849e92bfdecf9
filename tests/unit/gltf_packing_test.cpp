// Numbers with fewer bits, and what becomes of them in a file.
#include "writers/gltf/packing.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <set>

#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "tests/unit/temp_folder.h"
#include "writers/gltf/meshopt.h"

using namespace wrlkit;
using namespace wrlkit::gltf;
using Method = GltfCompression::Method;

namespace {

/// Converts a world and reads the glTF back; `summary` of what was written.
std::unique_ptr<World> there_and_back(const std::string& text, const GltfCompression& how, GltfSummary& summary) {
  TempFolder folder;
  Diagnostics diag;
  Statistics stats;
  PassContext ctx{diag, stats};
  auto world = parse_world(text, "test.wrl", {}, diag);
  std::string why;
  auto pipeline = Pipeline::parse("gltf", why);
  auto meshes = pipeline->run_lazily(world->scene, ctx, {});
  const auto path = folder / "small.glb";
  REQUIRE(write_gltf(world->scene, meshes, {.compression = how}, nullptr, path, diag, &summary));
  return read_world(path, {}, diag);
}

std::vector<std::vector<double>> points_of(const World& w) {
  std::vector<std::vector<double>> out;
  for (NodeId n : reachable(w.scene, w.scene.main))
    if (w.scene.is(n, nodes::Coordinate)) {
      auto p = w.scene.get(n, nodes::coordinate::point);
      out.emplace_back(p.begin(), p.end());
    }
  return out;
}

const std::string two_plates = R"(#VRML V2.0 utf8
Shape { appearance Appearance { material Material {} } geometry IndexedFaceSet { coord Coordinate { point [0.12345 0 0, 1.23456 0 0.77777, 1.23456 3.21987 0.77777, 0.12345 3.21987 0] } coordIndex [0 1 2 3 -1] } }
Shape { appearance Appearance { material Material {} } geometry IndexedFaceSet { coord Coordinate { point [1.23456 0 0.77777, 9.87654 0 5.4321, 9.87654 3.21987 5.4321, 1.23456 3.21987 0.77777] } coordIndex [0 1 2 3 -1] } }
)";

}  // namespace

TEST_CASE("The step of a grid is a power of two that moves nothing too far", "[packing]") {
  for (double tolerance : {1e-3, 2e-4, 0.7, 123.0}) {
    const double step = grid_step(tolerance);
    CHECK(std::exp2(std::round(std::log2(step))) == step);
    CHECK(step * std::sqrt(3.0) / 2 <= tolerance);
    CHECK(step * std::sqrt(3.0) > tolerance);
  }
}

TEST_CASE("What two parts share they share when they are quantised", "[packing]") {
  for (Method method : {Method::quantize, Method::meshopt}) {
    GltfSummary summary;
    auto back = there_and_back(two_plates, {.method = method, .tolerance = 1e-3}, summary);
    std::map<std::array<double, 3>, int> times;
    for (const auto& points : points_of(*back))
      for (std::size_t i = 0; i < points.size(); i += 3) ++times[{points[i], points[i + 1], points[i + 2]}];
    CHECK(std::ranges::count_if(times, [](const auto& t) { return t.second == 2; }) == 2);
    CHECK(times.size() == 6);
    CHECK(summary.quantization.position > 0);
    CHECK(summary.quantization.position <= 1e-3);
  }
}

TEST_CASE("A part that is scaled up has a finer grid", "[packing]") {
  const std::string scaled = R"(#VRML V2.0 utf8
Transform { scale 1000 1000 1000 children Shape { appearance Appearance { material Material {} } geometry IndexedFaceSet {
  coord Coordinate { point [0.12345 0 0, 1.23456 0 0.77777, 1.23456 3.21987 0.77777] } coordIndex [0 1 2 -1] } } })";
  GltfSummary summary;
  auto back = there_and_back(scaled, {.method = Method::meshopt, .tolerance = 1e-3}, summary);
  CHECK(summary.quantization.position <= 1e-3);
  const auto points = points_of(*back);
  REQUIRE(points.size() == 1);
  CHECK(points[0][0] == Approx(0.12345).margin(1e-6));
}

TEST_CASE("Without a tolerance a small world has a fine grid", "[packing]") {
  const std::string small = R"(#VRML V2.0 utf8
Shape { appearance Appearance { material Material {} } geometry Box { size 0.001 0.002 0.003 } })";
  GltfSummary summary;
  there_and_back(small, {.method = Method::quantize}, summary);
  CHECK(summary.quantization.tolerance < 1e-6);
  CHECK(summary.quantization.position <= summary.quantization.tolerance);
}

TEST_CASE("Floats on a grid come back from the form that the filter knows", "[packing]") {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> any(-50, 50);
  std::vector<float> values(999);
  for (float& v : values) v = any(random);
  const double step = grid_step(1e-3);
  const auto q = on_grid(values, 3, step);
  double error = 0;
  const auto floats = snapped(values, 3, step, error);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint32_t word;
    std::memcpy(&word, q.bytes.data() + i * 4, 4);
    const int exponent = static_cast<std::int8_t>(word >> 24), mantissa = static_cast<std::int32_t>(word << 8) >> 8;
    CHECK(static_cast<float>(std::ldexp(mantissa, exponent)) == floats[i]);
  }
  CHECK(q.error == error);
  CHECK(q.error <= 1e-3);
  CHECK(q.bounds.low[0] >= -50.001f);
}

TEST_CASE("Normals in a byte a component point the same way, but for a degree", "[packing]") {
  std::vector<float> normals;
  for (int i = 0; i < 500; ++i) {
    const double z = -1 + 2 * (i + 0.5) / 500, a = i * 2.399963, r = std::sqrt(1 - z * z);
    normals.insert(normals.end(),
                   {static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), static_cast<float>(z)});
  }
  CHECK(byte_normals(normals).error < 0.01);
  CHECK(octahedral_normals(normals, 8).error < 0.02);
  CHECK(octahedral_normals(normals, 4).error > octahedral_normals(normals, 8).error);
}

TEST_CASE("Vertices in the order in which they are drawn are the same triangles", "[packing]") {
  Vertices v;
  constexpr std::uint32_t side = 20;
  for (std::uint32_t i = 0; i < side * side; ++i)
    v.position.insert(v.position.end(), {static_cast<float>(i % side), static_cast<float>(i / side), 0.f});
  for (std::uint32_t y = side - 1; y-- > 0;)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = y * side + x;
      v.index.insert(v.index.end(), {a, a + 1, a + side + 1, a, a + side + 1, a + side});
    }
  auto triangles = [](const Vertices& m) {
    std::multiset<std::array<std::array<float, 3>, 3>> out;
    for (std::size_t i = 0; i < m.index.size(); i += 3) {
      std::array<std::array<float, 3>, 3> t;
      for (std::size_t k = 0; k < 3; ++k) std::copy_n(&m.position[m.index[i + k] * 3], 3, t[k].begin());
      std::rotate(t.begin(), std::ranges::min_element(t), t.end());
      out.insert(t);
    }
    return out;
  };
  const auto before = triangles(v);
  order_for_drawing(v);
  CHECK(triangles(v) == before);
  std::uint32_t next = 0;
  for (auto i : v.index) {
    CHECK(i <= next);  // in the order of their first use
    next = std::max(next, i + 1);
  }
}
