// One budget for the parts of a world: what is drawn is counted, what matters stays, what little matters leaves.
#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

#include "base/parallel.h"
#include "convert/diff.h"
#include "geometry/simplify/like_form.h"
#include "geometry/simplify/world_levels.h"
#include "parsers/parsers.h"
#include "passes/expand_protos/expand_protos.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"
#include "test_world.h"

using namespace wrlkit;
using namespace wrlkit::simplify;

namespace {

WorldLevels levels_of(TestWorld& w, std::vector<std::size_t> counts) {
  WorldSimplifyOptions options;
  options.counts = std::move(counts);
  return {w.scene, options, w.ctx};
}

std::string at(double x, double y, double z, const std::string& child) {
  std::ostringstream out;
  out.precision(12);
  out << "Transform { translation " << x << ' ' << y << ' ' << z << " children " << child << " }\n";
  return out.str();
}

/// A tank, a panel far from it, and bolts on the tank.
std::string tank_with_bolts(int n_bolts) {
  std::string text = "DEF Tank Shape { geometry Cylinder { radius 2 height 6 } }" +
                     at(20, 0, 0, "DEF Panel Shape { geometry Box { size 4 4 0.2 } }");
  for (int i = 0; i < n_bolts; ++i)
    text += at(2, -2 + 4. * i / n_bolts, 0,
               i ? "USE Bolt" : "DEF Bolt Shape { geometry Cylinder { radius 0.02 height 0.05 } }");
  return text;
}

NodeId named(const Scene& scene, std::string_view name) {
  for (NodeId n : all_nodes(scene))
    if (scene.name(n) == name) return n;
  return {};
}

bool is_drawn(const Scene& scene, std::string_view name) {
  const NodeId shape = named(scene, name);
  return shape && scene.get(shape, nodes::shape::geometry);
}

Deviation distance(const Scene& a, const Scene& b) {
  World x{a}, y{b};
  const auto d = diff(Document(std::move(x)), Document(std::move(y)));
  REQUIRE(d);
  REQUIRE(d->surface);
  return *d->surface;
}

std::size_t drawn(const Scene& scene) {
  World world{scene};
  auto facts = facts_of(Document(std::move(world)));
  REQUIRE(facts);
  return facts->geometry.triangles;
}

}  // namespace

TEST_CASE("world levels: a budget counts what is drawn, in all places", "[levels]") {
  TestWorld w(tank_with_bolts(30));
  const auto whole = drawn(w.scene);
  WorldSimplifyOptions options;
  options.ratios = {0.5, 0.25, 0.1};
  const WorldLevels levels(w.scene, options, w.ctx);
  CHECK(levels.n_drawn() == whole);
  CHECK(levels.n_faces() < whole / 5);
  REQUIRE(levels.points().size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = drawn(levels.scene_at(i));
    CHECK(n == levels.points()[i].n_drawn);
    CHECK(static_cast<double>(n) <= options.ratios[i] * static_cast<double>(whole));
    CHECK(static_cast<double>(n) >= 0.6 * options.ratios[i] * static_cast<double>(whole));
  }
}

TEST_CASE("world levels: each is farther from the world than the one before, as the diff sees it", "[levels]") {
  TestWorld w(tank_with_bolts(8));
  const auto levels = levels_of(w, {200, 100, 60, 40, 20, 10});
  REQUIRE(levels.points().size() == 6);
  double said = 0, measured = 0;
  for (std::size_t i = 0; i < levels.points().size(); ++i) {
    const auto d = distance(w.scene, levels.scene_at(i));
    CHECK(levels.points()[i].rms >= said);
    CHECK(d.rms >= 0.95 * measured);
    said = levels.points()[i].rms;
    measured = d.rms;
  }
  CHECK(measured < 1);
}

TEST_CASE("world levels: beams that are one form stretched differently are as far off as the diff sees it",
          "[levels]") {
  std::string text =
      "Shape { geometry Box { } } Transform { scale 1 60 1 children DEF Beam Shape { geometry Cylinder { radius 0.2 "
      "height 1 } } }";
  for (int i = 1; i < 12; ++i)
    text +=
        at(5. * i, 0, 0,
           "Transform { scale " + std::to_string(1 + i % 3) + ' ' + std::to_string(4 * i) + " 1 children USE Beam }");
  TestWorld w(text);
  const auto levels = levels_of(w, {300, 100, 60});
  REQUIRE(levels.points().size() == 3);
  for (std::size_t i = 0; i < levels.points().size(); ++i) {
    const auto d = distance(w.scene, levels.scene_at(i));
    const auto& said = levels.points()[i];
    CHECK(said.rms >= 0.9 * d.rms);
    CHECK(said.rms <= 1.5 * d.rms);
    CHECK(said.max >= 0.8 * d.max);
  }
}

TEST_CASE("world levels: bolts leave before tanks do, and names stay", "[levels]") {
  TestWorld w(tank_with_bolts(20));
  const auto levels = levels_of(w, {40});
  REQUIRE(levels.points().size() == 1);
  CHECK(levels.points()[0].n_gone == 1);
  const Scene left = levels.scene_at(0);
  CHECK(is_drawn(left, "Tank"));
  CHECK(is_drawn(left, "Panel"));
  CHECK_FALSE(is_drawn(left, "Bolt"));
  std::size_t n_names = 0;
  for (NodeId n : all_nodes(left)) n_names += !left.name(n).empty();
  CHECK(n_names == 3);
}

TEST_CASE("world levels: a coarse cylinder lies around the chords of the fine one, not within", "[levels]") {
  TestWorld w("Shape { geometry Cylinder { radius 1 height 8 top FALSE bottom FALSE } }" +
              at(9, 0, 0, "Shape { geometry Box { } }"));
  const auto levels = levels_of(w, {24});
  REQUIRE(levels.points().size() == 1);
  // Six sides within the circle are 0.134 away at most and 0.098 in the mean of squares; as large as it, 0.04.
  CHECK(distance(w.scene, levels.scene_at(0)).rms < 0.07);
}

TEST_CASE("world levels: paint on a floor counts although it lies on it", "[levels]") {
  const std::string floor =
                        "Shape { appearance Appearance { material Material { diffuseColor 0.5 0.5 0.5 } } "
                        "geometry Box { size 10 0.2 10 } }",
                    stripe = at(0, 0.101, 0,
                                "DEF Stripe Shape { appearance Appearance { material Material { "
                                "diffuseColor 1 1 0 } } geometry Box { size 9 0.002 0.5 } }"),
                    ball = at(0, 2, 0, "Shape { geometry Sphere { radius 0.2 } }");
  TestWorld w(floor + stripe + ball);
  const auto levels = levels_of(w, {40});
  REQUIRE(levels.points().size() == 1);
  CHECK(is_drawn(levels.scene_at(0), "Stripe"));
}

TEST_CASE("world levels: any number is reached, and the last part stays", "[levels]") {
  TestWorld w(tank_with_bolts(10));
  const auto levels = levels_of(w, {12, 6, 3});
  REQUIRE_FALSE(levels.points().empty());
  CHECK(levels.points().back().n_drawn <= 12);
  CHECK(levels.points().back().n_drawn > 0);
}

TEST_CASE("world levels: the same on any number of threads", "[levels]") {
  auto meshes = [] {
    TestWorld w(tank_with_bolts(10));
    const auto levels = levels_of(w, {100, 30});
    std::vector<double> out;
    for (std::size_t i = 0; i < levels.points().size(); ++i) {
      const Scene scene = levels.scene_at(i);
      for (NodeId n : all_nodes(scene))
        if (scene.is(n, nodes::Coordinate)) {
          const auto p = scene.get(n, nodes::coordinate::point);
          out.insert(out.end(), p.begin(), p.end());
        }
    }
    return out;
  };
  std::vector<double> one;
  {
    const ThreadLimit limit(1);
    one = meshes();
  }
  CHECK_FALSE(one.empty());
  CHECK(meshes() == one);
}

TEST_CASE("world levels: bad worlds are borne", "[levels]") {
  const std::string flat =
                        "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 2 0 0 ] } "
                        "coordIndex [ 0 1 2 -1 ] } }",
                    many =
                        "Shape { geometry IndexedFaceSet { solid FALSE coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 "
                        "0, 0 0 1, 0 -1 0 ] } coordIndex [ 0 1 2 -1 0 1 3 -1 0 1 4 -1 2 1 0 -1 ] } }",
                    ball = "Shape { geometry DEF S Sphere { } }", again = "Shape { geometry USE S }";
  const std::string worlds[] = {
      flat + ball + at(4, 0, 0, "Shape { geometry Box { } }"),
      many + at(3, 0, 0, ball),
      ball + "Transform { scale -1 1 1 translation 5 0 0 children " + again + " }" +
          at(9, 0, 0, "Shape { geometry Box { } }"),
      ball + "Transform { scale 0 1 1 children " + again + " }" + at(4, 0, 0, "Shape { geometry Box { } }"),
      ball + "Transform { scale 1 5 1 translation 9 0 0 children " + again + " }" +
          at(4, 0, 0, "Shape { geometry Box { } }"),
      at(5e6, 5e6, 5e6, ball) + at(5e6 + 4, 5e6, 5e6, "Shape { geometry Box { } }"),
      ball + ball + at(0, 0, 0, again)};
  for (const auto& text : worlds) {
    TestWorld w(text);
    const auto whole = drawn(w.scene);
    const auto levels = levels_of(w, {whole / 3, 8});
    REQUIRE_FALSE(levels.points().empty());
    for (std::size_t i = 0; i < levels.points().size(); ++i) {
      const Scene level = levels.scene_at(i);
      CHECK(drawn(level) <= levels.points()[i].n_drawn + 1);  // one has no area
      CHECK(std::isfinite(distance(w.scene, level).rms));
    }
  }
}

TEST_CASE("world levels: numbers of triangles are met by rungs that are off the hull", "[levels]") {
  TestWorld w("Shape { geometry DEF B Sphere { } }" + at(9, 0, 0, "Shape { geometry Box { } }"));
  std::vector<std::size_t> counts;
  for (std::size_t n = 400; n > 40; n -= 20) counts.push_back(n);
  const auto levels = levels_of(w, counts);
  REQUIRE(levels.points().size() >= 8);
  for (std::size_t i = 0; i < levels.points().size(); ++i) {
    const auto& p = levels.points()[i];
    CHECK(drawn(levels.scene_at(i)) == p.n_drawn);
    if (i > 0) CHECK(p.n_drawn < levels.points()[i - 1].n_drawn);
  }
}

TEST_CASE("world levels: parts below an instance of a prototype", "[levels]") {
  const std::string proto =
      "PROTO Joint [ exposedField SFVec3f translation 0 0 0 exposedField MFNode children [] ] "
      "{ Transform { translation IS translation children IS children } } ";
  const std::string parts = at(3, 0, 0, "DEF Ball Shape { geometry Sphere { } }") +
                            at(6, 0, 0, "DEF Ball2 Shape { geometry Sphere { radius 2 } }");
  TestWorld w(proto + "Joint { translation 5 0 0 children [ " + parts + " ] }");
  WorldSimplifyOptions options;
  options.ratios = {0.1};
  Scene expanded = w.scene;
  REQUIRE(expand_protos(expanded, {}, w.ctx) == Outcome::changed);
  options.expanded = &expanded;
  const WorldLevels levels(w.scene, options, w.ctx);
  CHECK(levels.n_parts() == 2);
  REQUIRE(levels.points().size() == 1);
  CHECK(levels.points()[0].n_drawn <= levels.n_drawn() / 10);
  const Scene level = levels.scene_at(0);
  CHECK(distance(w.scene, level).rms > 0);
  CHECK(is_drawn(level, "Ball2"));
}

TEST_CASE("world levels: all numbers of triangles, until hardly anything is left", "[levels]") {
  std::string text = tank_with_bolts(4);
  for (int i = 1; i < 12; ++i)
    text += at(4. * i, 10, 0, "Shape { geometry Sphere { radius " + std::to_string(0.3 * i) + " } }");
  TestWorld w(text);
  WorldSimplifyOptions options;
  options.every = 150;
  const WorldLevels levels(w.scene, options, w.ctx);
  REQUIRE(levels.points().size() > 20);
  for (std::size_t i = 1; i < levels.points().size(); ++i)
    CHECK(levels.points()[i].n_drawn < levels.points()[i - 1].n_drawn);
  CHECK(levels.points().back().n_drawn <= 150);
}

TEST_CASE("world levels: a pipe of few sides is as smooth as the pipe was, a box has flat faces", "[levels]") {
  TestWorld w("DEF Pipe Shape { geometry Cylinder { height 20 } }" +
              at(5, 0, 0,
                 "DEF Boxes Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 1 1 0 0 1 0 "
                 "0 0 1 1 0 1 1 1 1 0 1 1 ] } coordIndex [ 0 3 2 1 -1 4 5 6 7 -1 0 1 5 4 -1 1 2 6 5 -1 "
                 "2 3 7 6 -1 3 0 4 7 -1 ] } }"));
  const auto levels = levels_of(w, {30});
  REQUIRE(levels.points().size() == 1);
  const Scene level = levels.scene_at(0);
  const NodeId pipe = level.get(named(level, "Pipe"), nodes::shape::geometry);
  const NodeId boxes = level.get(named(level, "Boxes"), nodes::shape::geometry);
  CHECK_FALSE(level.get(boxes, nodes::indexed_face_set::normal));
  const NodeId normal = level.get(pipe, nodes::indexed_face_set::normal);
  REQUIRE(normal);
  const auto vectors = level.get(normal, nodes::normal::vector);
  for (std::size_t i = 0; i + 2 < vectors.size(); i += 3) {
    const double across = std::hypot(vectors[i], vectors[i + 2]);
    CHECK((across > 0.9 || across < 0.1));  // of the wall, or of a cap
  }
}

TEST_CASE("world levels: the letters of a text are parts as others", "[levels]") {
  const std::string text = "DEF Label Shape { geometry Text { string \"pump room\" } }";
  TestWorld w(tank_with_bolts(0) + at(0, 4, 0, text));
  WorldSimplifyOptions options;
  options.ratios = {0.5, 0.1};
  options.text = OfText::take;
  const WorldLevels levels(w.scene, options, w.ctx);
  REQUIRE(drawn(TestWorld(text).scene) > drawn(w.scene) / 2);
  REQUIRE(levels.points().size() == 2);
  CHECK(is_drawn(levels.scene_at(0), "Label"));
  CHECK(distance(w.scene, levels.scene_at(0)).rms < 0.005);
  CHECK(distance(w.scene, levels.scene_at(1)).rms < 0.05);
  CHECK(levels.n_texts_as_faces() == 1);
  CHECK(is_drawn(levels.scene_at(1), "Tank"));
  levels.report_missed(w.ctx.diag);
  CHECK(w.diag.messages().empty());
}

TEST_CASE("world levels: what must stay is not paid for by all the rest", "[levels]") {
  const std::string below_lod = "LOD { range 9 level [ Group { children [ " +
                                at(9, 0, 0, "DEF Ball Shape { geometry Sphere { } }") + at(-9, 0, 0, "USE Ball") +
                                " ] } Shape { geometry Box { } } ] }";
  TestWorld w(tank_with_bolts(4) + below_lod);
  const auto n_left = drawn(TestWorld(below_lod).scene);
  WorldSimplifyOptions options;
  options.ratios = {0.5, 0.25};
  const WorldLevels levels(w.scene, options, w.ctx);
  const auto n_rest = levels.n_drawn() - n_left;
  REQUIRE(n_left > levels.n_drawn() / 2);
  REQUIRE(levels.points().size() == 2);
  CHECK(levels.points()[1].n_drawn - n_left <= n_rest / 8);
  CHECK(levels.points()[1].n_drawn - n_left >= n_rest / 16);
  CHECK(is_drawn(levels.scene_at(1), "Tank"));
  levels.report_missed(w.ctx.diag);
  CHECK(w.diag.messages().back().args[0].find("cannot be reached: " + std::to_string(n_left) +
                                              " a Shape below a LOD") != std::string::npos);
}
