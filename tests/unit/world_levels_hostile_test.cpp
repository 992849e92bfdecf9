// World levels of worlds that want all the time or all the memory, or that have no good answer.
#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>
#include <sstream>

#include "convert/diff.h"
#include "geometry/simplify/allocation.h"
#include "geometry/simplify/surface_places.h"
#include "geometry/simplify/world_levels.h"
#include "scenegraph/nodes.h"
#include "scenegraph/places/places.h"
#include "test_world.h"

using namespace wrlkit;
using namespace wrlkit::simplify;

namespace {

const std::string ball = "Shape { geometry Sphere { radius 3 } }\n";

/// A bolt in 2^n places, in a grid.
std::string nested(int n) {
  std::ostringstream out;
  for (int i = n; i > 0; --i) out << "DEF G" << i << " Group { children [ ";
  out << "DEF G0 Group { children Shape { geometry Cylinder { radius 0.02 height 0.05 } } }";
  for (int i = 1; i <= n; ++i) {
    const double step = 0.2 * std::pow(2., std::min(i / 3, 12));
    out << " Transform { translation " << (i % 3 == 0 ? step : 0) << ' ' << (i % 3 == 1 ? step : 0) << ' '
        << (i % 3 == 2 ? step : 0) << " children USE G" << i - 1 << " } ] }";
  }
  return out.str();
}

std::vector<WorldLevels::Point> points_of(const std::string& text, std::vector<double> ratios = {0.25, 0.03}) {
  TestWorld w(text);
  WorldSimplifyOptions options;
  options.ratios = std::move(ratios);
  const WorldLevels levels(w.scene, options, w.ctx);
  auto points = levels.points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    CHECK(std::isfinite(points[i].rms));
    CHECK(std::isfinite(points[i].max));
    CHECK(levels.scene_at(i).node_count() >= w.scene.node_count());
  }
  return points;
}

/// Hills of 2 n^2 triangles.
std::string terrain(int n) {
  std::ostringstream points, faces;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) points << x << ' ' << 3 * std::sin(x / 20.) * std::cos(y / 15.) << ' ' << y << ',';
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + n + 1;
      faces << a << ' ' << b << ' ' << a + 1 << " -1 " << a + 1 << ' ' << b << ' ' << b + 1 << " -1 ";
    }
  return "Shape { geometry IndexedFaceSet { solid FALSE coord Coordinate { point [" + points.str() +
         "] } coordIndex [" + faces.str() + "] } }\n";
}

std::string bolts(int n, double apart) {
  std::ostringstream out;
  out << "Transform { translation 0 9 0 children DEF B Shape { geometry Cylinder { radius 0.02 height 0.05 } } }\n";
  for (int i = 1; i < n; ++i)
    out << "Transform { translation " << apart * (i % 1000) << " 9 " << apart * (i / 1000) << " children USE B }\n";
  return out.str();
}

}  // namespace

TEST_CASE("world levels: a part in thousands of places and more by USE of USE", "[levels][hostile]") {
  for (const int n : {14, 17}) {
    const auto points = points_of(ball + nested(n));
    REQUIRE(points.size() == 2);
    const double bolts = std::ldexp(1, n);
    CHECK(static_cast<double>(points[0].n_drawn) <= 0.25 * (44 * bolts + 2000));
    CHECK(static_cast<double>(points[1].n_drawn) >= bolts);  // none of them can leave
    CHECK(points[0].rms < 0.01);
  }
}

TEST_CASE("world levels: more places than can be counted", "[levels][hostile]") {
  TestWorld w(ball + nested(70));
  WorldSimplifyOptions options;
  options.ratios = {0.1};
  const WorldLevels levels(w.scene, options, w.ctx);
  CHECK(levels.n_drawn() > WorldLevels::most_drawn);
  CHECK(levels.n_parts() == 0);
  CHECK(levels.points().empty());
}

TEST_CASE("world levels: a chain of groups as deep as the bolts are many", "[levels][hostile]") {
  TestWorld w(ball + "Group { children [ " + nested(20) + " ] }");
  Scene& scene = w.scene;
  // Deeper than a file may be.
  for (int i = 0; i < 20'000; ++i) {
    const NodeId group = scene.add(nodes::Group, {});
    scene.set(group, nodes::group::children, std::vector<NodeId>{scene.main.roots[1]});
    scene.main.roots[1] = group;
  }
  WorldSimplifyOptions options;
  options.ratios = {0.25};
  CHECK(WorldLevels(scene, options, w.ctx).points().size() == 1);
}

TEST_CASE("world levels: hundreds of thousands of bolts in a list", "[levels][hostile]") {
  const auto points = points_of(ball + bolts(200'000, 0.1));
  REQUIRE(points.size() == 2);
  CHECK(points[1].n_drawn <= 0.03 * 8.8e6);
}

TEST_CASE("world levels: coincident copies", "[levels][hostile]") {
  const auto points = points_of(ball + bolts(10'000, 0));
  REQUIRE(points.size() == 2);
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "Shape { geometry Box { } }\n";
  CHECK(points_of(ball + many).back().rms < 0.3);
}

TEST_CASE("world levels: one part of very many triangles among bolts", "[levels][hostile]") {
  const auto points = points_of(terrain(250) + bolts(100, 1), {0.1, 0.01});
  REQUIRE(points.size() == 2);
  CHECK(points[0].n_drawn <= 12'940);
  CHECK(points[1].n_drawn <= 1'294);
  CHECK(points[0].rms <= points[1].rms);
}

TEST_CASE("world levels: parts without a form", "[levels][hostile]") {
  const auto faces = [](const std::string& points, const std::string& index) {
    return "Shape { geometry IndexedFaceSet { coord Coordinate { point [ " + points + " ] } coordIndex [ " + index +
           " ] } }\n";
  };
  const std::string tetrahedron = "0 1 2 -1 0 2 3 -1 0 3 1 -1 1 3 2 -1", box = "Shape { geometry Box { } }\n";
  const std::string worlds[] = {
      faces("0 0 0, 0 0 0, 0 0 0, 0 0 0", tetrahedron),                              // a point
      faces("0 0 0, 1 0 0, 2 0 0, 3 0 0", tetrahedron),                              // a line
      faces("0 0 0, 1 0 0, 0 1 0, 1 1 0", tetrahedron),                              // of no thickness
      faces("nan 0 0, 1 0 0, 0 1 0, 0 0 1", tetrahedron),                            // not a number
      faces("1e300 0 0, 1 0 0, 0 -1e300 0, 0 0 1", tetrahedron),                     // huge
      faces("1e30 0 0, 1e30 1 0, 1e30 0 1, 1e30 1 1", tetrahedron),                  // huge, and small there
      faces("5e6 5e6 0, 5000000.1 5e6 0, 5e6 5000000.1 0, 5e6 5e6 1", tetrahedron),  // far away
      faces("1e-30 0 0, 0 1e-30 0, 0 0 1e-30, 0 0 0", tetrahedron),                  // tiny
      faces("", ""),                                                                 // nothing
      faces("0 0 0, 1 0 0, 0 1 0", "0 1 7 -1 0 0 0 -1"),                             // beyond its points
      "Transform { scale 0 0 0 children " + box + " }\n",
      "Transform { scale 1e200 1e200 1e200 children Transform { scale 1e200 1e200 1e200 children " + box + " } }\n"};
  for (const auto& text : worlds) {
    INFO(text);
    for (const double ratio : {0.5, 0.1})
      points_of(text + ball + "Transform { translation 9 0 0 children " + box + " }\n", {ratio});
    points_of(text + text, {0.5});
  }
}

TEST_CASE("allocation: a step that has become dearer waits for the cheaper one", "[levels]") {
  // Twin plates in one place, and a small one far away. When one twin has left, the other matters.
  const std::vector<double> positions{0, 0, 0, 4, 0, 0, 0, 4, 0, 9, 0, 0, 9.1, 0, 0, 9, 0.1, 0};
  const std::vector<std::uint32_t> corners{0, 1, 2, 3, 4, 5};
  const Triangles surface{positions, corners};
  const std::vector<Rung> rungs{{{}, 1, {}, false}};
  const std::uint32_t faces[] = {0, 0, 1};
  Neighbours neighbours;
  std::vector<AllocatedPart> parts(3);
  for (std::uint32_t i = 0; i < 3; ++i) {
    neighbours.add(surface, {&faces[i], 1}, {}, i);
    neighbours.end_part();
    parts[i] = {&rungs, 1, i, 1, {}, 0, {}};
    for (const Vec3& p : surface[faces[i]]) {
      LeavingSample sample{p, i == 2 ? 0.005 / 3 : 8. / 3, 0, 0, ClosestPoint::no_guess, 0};
      sample.is_asked = false;
      parts[i].leaving.push_back(sample);
    }
  }
  neighbours.prepare();
  Allocation allocation(parts, neighbours, 16);
  REQUIRE(allocation.run_to(1));
  CHECK(allocation.rungs() == std::vector<std::uint32_t>{Allocation::gone, 0, Allocation::gone});
  CHECK(allocation.rms() < 0.1);
}

TEST_CASE("places: some of very many, spread over all ways", "[levels]") {
  TestWorld w(nested(12));
  const auto surfaces = surfaces_of(w.scene);
  const ShownTimes shown(w.scene);
  REQUIRE(surfaces.size() == 1);
  CHECK(shown.of(surfaces[0]) == 4096);
  std::vector<Matrix> followed;
  for_each_place(w.scene, Shown::now, [&](NodeId, const Matrix& m) { followed.push_back(m); });
  CHECK(some_places(w.scene, shown, surfaces, 4096)[0] == followed);

  // By their numbers they are the same places.
  const NumberedPlaces numbered(w.scene, shown.nodes, shown.times);
  std::vector<std::array<long, 3>> a, b;
  const auto steps = [](const Matrix& m) {
    return std::array{std::lround(m(0, 3) / 0.2), std::lround(m(1, 3) / 0.2), std::lround(m(2, 3) / 0.2)};
  };
  for (std::uint64_t i = 0; i < 4096; ++i) {
    a.push_back(steps(followed[i]));
    b.push_back(steps(numbered.place(surfaces[0].shapes[0], i)));
  }
  std::ranges::sort(a);
  std::ranges::sort(b);
  CHECK(a == b);

  const auto some = some_places(w.scene, shown, surfaces, 100)[0];
  REQUIRE(some.size() == 100);
  const auto mean = [](const std::vector<Matrix>& places) {
    Vec3 sum{};
    for (const auto& m : places) sum = sum + m.column(3);
    return (1. / static_cast<double>(places.size())) * sum;
  };
  CHECK(length(mean(some) - mean(followed)) < 0.1 * length(mean(followed)));
}
