// Levels of detail: what errors they have, what distances follow from them, and what is left alone.
#include <catch2/catch.hpp>

#include <cmath>
#include <set>
#include <sstream>

#include "geometry/closest_point.h"
#include "geometry/simplify/lod_nodes.h"
#include "geometry/simplify/shared_borders.h"
#include "geometry/simplify/world.h"
#include "parsers/parsers.h"
#include "passes/lod/lod.h"
#include "scenegraph/nodes.h"
#include "scenegraph/verify.h"
#include "scenegraph/walk.h"
#include "test_world.h"

using namespace wrlkit;

namespace {

/// A bumpy sheet of n by n quadrilaterals, one unit wide, as triangles.
Mesh sheet(std::size_t n, double height) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  auto& p = m.positions.edit();
  for (std::size_t y = 0; y <= n; ++y)
    for (std::size_t x = 0; x <= n; ++x) {
      const double u = double(x) / double(n), v = double(y) / double(n);
      p.insert(p.end(), {u, v, height * std::sin(7 * u) * std::cos(5 * v)});
    }
  auto at = [&](std::size_t x, std::size_t y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x)
      for (auto c : {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y), at(x + 1, y + 1), at(x, y + 1)})
        m.corners.push_back(c);
  return m;
}

std::vector<NodeId> all_of(const Scene& scene, TypeId type) {
  auto nodes = all_nodes(scene);
  std::erase_if(nodes, [&](NodeId n) { return !scene.is(n, type); });
  return nodes;
}

}  // namespace

TEST_CASE("levels: each is coarser and farther away than the one before", "[lod]") {
  const auto first = sheet(40, 0.05);
  const auto levels = make_levels(first, {.ratios = {0.5, 0.25, 0.1}});
  REQUIRE(levels.size() == 3);
  std::size_t n = first.n_faces();
  double error = 0;
  for (const auto& level : levels) {
    CHECK(level.mesh.n_faces() < n);
    CHECK(level.error > error);
    CHECK(level.rms <= level.error);
    n = level.mesh.n_faces();
    error = level.error;
  }
  CHECK(levels[0].mesh.n_faces() <= 1600);
  CHECK(levels[2].mesh.n_faces() <= 320);
}

TEST_CASE("levels: errors are kept, and most of what they allow is used", "[lod]") {
  const auto first = sheet(40, 0.05);
  const auto levels = make_levels(first, {.errors = {0.001, 0.01}});
  REQUIRE(levels.size() == 2);
  CHECK(levels[0].error <= 0.001);
  CHECK(levels[1].error <= 0.01);
  CHECK(levels[1].error > 0.003);
  CHECK(levels[0].mesh.n_faces() < first.n_faces() / 2);
}

TEST_CASE("levels: one that saves too little is left out, and none is smaller than a box", "[lod]") {
  const auto first = sheet(40, 0.05);
  CHECK(make_levels(first, {.ratios = {0.5, 0.45, 0.1}, .min_saving = 0.3}).size() == 2);
  const auto flat = make_levels(sheet(40, 0), {.ratios = {0.001}});
  REQUIRE(flat.size() == 1);
  CHECK(flat[0].mesh.n_faces() == 12);
  CHECK(flat[0].error < 1e-12);
}

TEST_CASE("levels: positions are printed with seven digits of the extent", "[lod]") {
  Mesh m = sheet(10, 0.05);
  for (auto& p : m.positions.edit()) p = p * 30 + 5'000'000;
  for (const auto& level : make_levels(m, {.ratios = {0.5}}))
    for (double p : level.mesh.positions.span()) CHECK(p * 1e5 == Approx(std::round(p * 1e5)).margin(1e-3));
}

TEST_CASE("screen budget: a metre covers one pixel as far away as the field of view says", "[lod]") {
  CHECK(ScreenBudget{.screen_height = 1000, .field_of_view = M_PI / 2}.per_pixel() == Approx(500));
}

TEST_CASE("lod: ranges are where the error of the next level falls below a pixel", "[lod]") {
  TestWorld w("Shape { geometry Sphere { radius 2 } }");
  LodOptions options;
  options.ratios.values = {0.5, 0.1};
  REQUIRE(lod(w.scene, options, w.ctx) == Outcome::changed);
  REQUIRE(w.scene.is(w.scene.main.roots[0], nodes::LOD));
  const auto range = w.scene.get(w.scene.main.roots[0], nodes::lod::range);
  REQUIRE(range.size() == 2);

  Mesh mesh;
  TestWorld same("Shape { geometry Sphere { radius 2 } }");
  SurfaceReader reader(same.scene, same.ctx);
  const auto surfaces = surfaces_of(same.scene);
  REQUIRE(surfaces.size() == 1);
  reader.read(surfaces[0], mesh);
  const auto levels = make_levels(mesh, {.ratios = {0.5, 0.1}});
  REQUIRE(levels.size() == 2);
  const double per_pixel = 1080 / (2 * std::tan(0.785398 / 2));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(range[i] >= 2 + levels[i].error * per_pixel);
    CHECK(range[i] <= (2 + levels[i].error * per_pixel) * 1.002);
  }
}

TEST_CASE("lod: an empty last level from where a part is below a pixel", "[lod]") {
  TestWorld w("Shape { geometry Sphere { radius 2 } }");
  LodOptions options;
  options.ratios.values = {0.25};
  options.vanish = 1;
  REQUIRE(lod(w.scene, options, w.ctx) == Outcome::changed);
  NodeId n = w.scene.main.roots[0];
  const auto children = w.scene.get(n, nodes::lod::children);
  REQUIRE(children.size() == 3);
  CHECK(w.scene.is(children[2], nodes::Group));
  CHECK(w.scene.get(n, nodes::lod::range)[1] > 4 * 1080 / (2 * std::tan(0.785398 / 2)));
}

TEST_CASE("lod: nothing is changed where there is nothing to gain, or somebody listens", "[lod]") {
  const char* worlds[] = {
      "Shape { geometry Box { } }",
      "Shape { geometry Text { string \"a b c d e f g h i j k\" } }",
      "LOD { level [ Shape { geometry Sphere { } } ] }",
      "DEF S Shape { geometry Sphere { } } DEF R Script { eventOut SFNode n } ROUTE R.n TO S.set_geometry",
      "Shape { geometry IndexedFaceSet { coord DEF C Coordinate { } } } DEF I CoordinateInterpolator { } ROUTE "
      "I.value_changed TO C.set_point",
      "PROTO P [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } } P { }",
      "Shape { }",
      "",
  };
  for (const auto* text : worlds) {
    TestWorld w(text);
    CHECK(lod(w.scene, {}, w.ctx) == Outcome::unchanged);
  }
}

TEST_CASE("lod: a second run changes nothing", "[lod]") {
  TestWorld w("Group { children [ Shape { geometry DEF G Sphere { } } Shape { geometry USE G } ] }");
  REQUIRE(lod(w.scene, {}, w.ctx) == Outcome::changed);
  CHECK(all_of(w.scene, nodes::LOD).size() == 2);
  CHECK(all_of(w.scene, nodes::IndexedFaceSet).size() == 3);
  CHECK(verify(w.scene, Level::authored, w.diag));
  CHECK(lod(w.scene, {}, w.ctx) == Outcome::unchanged);
}

TEST_CASE("simplified world: triangles go where they are missed least", "[lod]") {
  // A ball whose facets are seen, and a flat sheet of which twelve triangles are as good as two hundred.
  std::string points, index;
  for (int y = 0; y <= 10; ++y)
    for (int x = 0; x <= 10; ++x) points += std::to_string(x) + ' ' + std::to_string(y) + " 0,";
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 10; ++x) {
      const int a = y * 11 + x;
      index += std::to_string(a) + ' ' + std::to_string(a + 1) + ' ' + std::to_string(a + 12) + ' ' +
               std::to_string(a + 11) + " -1 ";
    }
  TestWorld w("Shape { geometry Sphere { } } Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + points +
              " ] } coordIndex [ " + index + " ] } }");
  Mesh ball;
  const auto surfaces = surfaces_of(w.scene);
  REQUIRE(surfaces.size() == 2);
  SurfaceReader(w.scene, w.ctx).read(surfaces[0], ball);
  WorldSimplifyOptions options;
  options.ratios = {(double(ball.n_faces()) + 12) / (double(ball.n_faces()) + 200)};
  const SimplifiedWorld simple(w.scene, options, w.ctx);
  REQUIRE(simple.n_points() == 1);
  CHECK(simple.n_faces() == ball.n_faces() + 200);
  CHECK(simple.point(0).error < 0.02);
  auto scene = simple.scene_at(0);
  Mesh left;
  TestWorld again("");
  again.scene = scene;
  SurfaceReader reader(again.scene, again.ctx);
  reader.read(surfaces_of(again.scene)[1], left);
  CHECK(left.n_faces() <= 20);
}

namespace {

/// An IndexedFaceSet of n by n quadrilaterals with waves, from x to x + 1 and 0 to 1, by a scale.
std::string plate(int n, double x, double scale) {
  std::ostringstream points, index;
  points.precision(9);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double u = x + double(i) / n, v = double(j) / n;
      points << u * scale << ' ' << v * scale << ' ' << 0.05 * std::sin(9 * v + 2 * u) * scale << ", ";
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      index << a << ' ' << a + 1 << ' ' << a + n + 2 << ' ' << a + n + 1 << " -1 ";
    }
  return "IndexedFaceSet { coord Coordinate { point [ " + points.str() + " ] } coordIndex [ " + index.str() + " ] }";
}

/// The positions of a geometry where x is `at`, by a scale and rounded to what single precision holds.
std::set<Vec3> cut(TestWorld& w, NodeId geometry, double at, double scale) {
  Mesh mesh;
  SurfaceReader(w.scene, w.ctx).read({geometry, {}}, mesh);
  std::set<Vec3> out;
  for (auto c : mesh.corners) {
    Vec3 p = triangles_of(mesh).position(c);
    for (double& x : p) x = std::round(x * scale * 1e7) / 1e7;
    if (std::abs(p[0] - at) < 1e-6) out.insert(p);
  }
  return out;
}

}  // namespace

TEST_CASE("lod: parts that share a border meet at all levels", "[lod]") {
  // The second plate is ten times as large and scaled down; the third stands apart from them.
  TestWorld w("Shape { geometry " + plate(20, 0, 1) + " } Transform { scale 0.1 0.1 0.1 children Shape { geometry " +
              plate(20, 1, 10) + " } } Transform { translation 0 0 9 children Shape { geometry " + plate(20, 0, 1) +
              " } }");
  REQUIRE(lod(w.scene, {}, w.ctx) == Outcome::changed);
  const auto lods = all_of(w.scene, nodes::LOD);
  REQUIRE(lods.size() == 3);
  std::vector<std::set<Vec3>> borders;
  for (std::size_t part : {0, 1}) {
    const auto levels = w.scene.get(lods[part], nodes::lod::children);
    CHECK(levels.size() > 2);
    for (NodeId shape : levels)
      borders.push_back(cut(w, w.scene.get(shape, nodes::shape::geometry), 1, part ? 0.1 : 1));
  }
  CHECK(borders[0].size() == 21);
  for (const auto& b : borders) CHECK(b == borders[0]);
  const auto alone = w.scene.get(lods[2], nodes::lod::children);
  CHECK(cut(w, w.scene.get(alone.back(), nodes::shape::geometry), 1, 1).size() < 15);
}

TEST_CASE("shared borders: places of one geometry, and what is no border", "[lod]") {
  // Turned by half around the middle of its border x = 1, a plate would meet itself there, but its waves of v and 1 - v
  // differ. A flat sheet does so with two corners. The boxes are in one place, but they are closed.
  const std::string box = "Transform { translation 0 0 7 children Shape { geometry Box { size 2 2 2 } } }";
  const std::string turned =
      "Transform { translation 2 1 0 rotation 0 0 1 3.141592653589793 children Shape { geometry ";
  const std::string flat =
      "IndexedFaceSet { coord Coordinate { point [ 0 0 5, 1 0 5, 1 1 5, 0 1 5 ] } coordIndex [ 0 1 2 3 ] }";
  TestWorld w("Shape { geometry DEF P " + plate(5, 0, 1) + " }" + turned + "USE P } } Shape { geometry DEF F " + flat +
              " }" + turned + "USE F } } " + box + box);
  const auto surfaces = surfaces_of(w.scene);
  SharedBorders borders;
  SurfaceReader reader(w.scene, w.ctx);
  Mesh mesh;
  for (const auto& s : surfaces) {
    reader.read(s, mesh);
    borders.add(mesh);
  }
  const auto fixed = borders.find(w.scene, surfaces);
  REQUIRE(fixed.size() == 4);
  CHECK(fixed[0].empty());
  CHECK(fixed[1] == std::vector<std::uint32_t>{1, 2});
  CHECK(fixed[2].empty());
  CHECK(fixed[3].empty());
}

TEST_CASE("shared borders: a surface twice in one place does not border on itself", "[lod]") {
  TestWorld w("Switch { whichChoice 0 choice [ Shape { geometry DEF P " + plate(5, 0, 1) +
              " } Group { children Shape { geometry USE P } } ] }");
  const auto surfaces = surfaces_of(w.scene);
  REQUIRE(surfaces.size() == 1);
  SharedBorders borders;
  SurfaceReader reader(w.scene, w.ctx);
  Mesh mesh;
  reader.read(surfaces[0], mesh);
  borders.add(mesh);
  CHECK(borders.find(w.scene, surfaces)[0].empty());
}

TEST_CASE("errors are metres of the world, ranges are not", "[lod]") {
  const auto ball = [](const std::string& scale) {
    return "Transform { scale " + scale + " children Shape { geometry DEF S Sphere { radius 1000 } } }";
  };
  LodOptions options;
  options.ratios.values = {0.25};
  std::vector<double> ranges;
  for (const auto& world : {ball("1 1 1"), ball("0.001 0.001 0.001")}) {
    TestWorld w(world);
    REQUIRE(lod(w.scene, options, w.ctx) == Outcome::changed);
    const auto range = w.scene.get(all_of(w.scene, nodes::LOD)[0], nodes::lod::range);
    ranges.insert(ranges.end(), range.begin(), range.end());
  }
  REQUIRE(ranges.size() == 2);
  CHECK(ranges[0] == ranges[1]);

  // The sphere is one metre large, and two where it is used again.
  TestWorld w(ball("0.001 0.001 0.001") + "Transform { scale 0.002 0.002 0.002 children Shape { geometry USE S } }");
  WorldSimplifyOptions within;
  within.errors = {0.05};
  const SimplifiedWorld simple(w.scene, within, w.ctx);
  REQUIRE(simple.n_points() == 1);
  CHECK(simple.point(0).error <= 0.05);
  CHECK(simple.point(0).error > 0.02);
  options.errors.values = {0.05};
  REQUIRE(lod(w.scene, options, w.ctx) == Outcome::changed);
  const auto range = w.scene.get(all_of(w.scene, nodes::LOD)[0], nodes::lod::range);
  REQUIRE(range.size() == 1);
  CHECK(range[0] <= 1001 + 25 * ScreenBudget{}.per_pixel() * 1.002);  // 0.05 m are 25 units
  CHECK(range[0] > 1000 + 10 * ScreenBudget{}.per_pixel());
}
