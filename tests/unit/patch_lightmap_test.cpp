// From patches to textures: which triangle a patch belongs to, how it is drawn, and where corners lie in the picture.
#include "light/patches/patch_lightmap.h"

#include <catch2/catch.hpp>
#include <memory>

#include "light/flux.h"
#include "light/patches/smooth_patches.h"
#include "parsers/parsers.h"
#include "passes/pipeline/pipeline.h"

using namespace wrlkit;
using namespace wrlkit::light;

namespace {

/// A wall of two triangles, 2 m wide and 1 m high, and a floor.
const std::string_view room = R"(#VRML V2.0 utf8
DEF Wall Shape { appearance Appearance { material Material { diffuseColor 0.5 0.5 0.5 emissiveColor 0.1 0.1 0.1 } }
  geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 2 0 0, 2 1 0, 0 1 0] } coordIndex [0 1 2 3 -1] } }
DEF Floor Shape { appearance Appearance { material Material { } }
  geometry IndexedFaceSet { coord Coordinate { point [0 0 0, 0 0 2, 2 0 2, 2 0 0] } coordIndex [0 1 2 3 -1] } })";

struct Room {
  Diagnostics diag;
  std::unique_ptr<World> world;
  std::unique_ptr<LightWorld> light;

  explicit Room(std::string_view text = room) : world(parse_world(text, "room.wrl", {}, diag)) {
    Statistics stats;
    PassContext ctx{diag, stats};
    std::string why;
    auto pipeline = Pipeline::parse("tessellate", why);
    auto meshes = pipeline->run_lazily(world->scene, ctx);
    light = std::make_unique<LightWorld>(world->scene, meshes, nullptr, LightOptions{}, diag);
  }
};

/// The left half of the wall in one colour and the right half in another, each of two patches, without triangles.
PatchSet halves(double nudge = 0) {
  PatchSet set;
  set.add_shape("", PatchSet::unknown);
  set.add_loose_triangle();
  auto add = [&](double x0, double x1, float c) {
    set.patches.push_back({{Vec3{x0, nudge, nudge}, Vec3{x1, 0, nudge}, Vec3{x1, 1, 0}}, {c, c, c}});
    set.patches.push_back({{Vec3{x0, 0, 0}, Vec3{x1, 1, nudge}, Vec3{x0, 1, 0}}, {c, c, c}});
  };
  add(0, 1, 0.25f);
  add(1, 2, 0.75f);
  return set;
}

double at(const ShapePicture& s, double x, double y) {
  auto picture = s.picture;
  return picture.at(static_cast<int>(x * picture.width), static_cast<int>((1 - y) * picture.height)).x;
}

}  // namespace

TEST_CASE("patches without triangles are found by where they lie, printed digits or not") {
  const Room r;
  for (double nudge : {0.0, 1e-6, -1e-6}) {
    const auto match = match_patches(halves(nudge), *r.light);
    CHECK(match.n_orphans == 0);
    REQUIRE(match.placed.size() == 4);
    for (const auto& p : match.placed) {
      CHECK(p.use == 0);
      CHECK(!p.back);
    }
  }
}

TEST_CASE("a file's triangles are believed when they are right, and looked for when not") {
  const Room r;
  for (std::uint32_t shape : {0u, 1u, 99u}) {
    auto set = halves();
    set.shapes[0].index = shape;
    const auto t = triangle_of(*r.light, 0, 0);
    set.triangles[0].given = true;
    set.triangles[0].index = 0;
    for (std::size_t i = 0; i < 3; ++i) set.triangles[0].corners[i] = {t[i].x, t[i].y, t[i].z};
    const auto match = match_patches(set, *r.light);
    CHECK(match.placed.size() == 4);
    for (const auto& p : match.placed) CHECK(p.use == 0);
  }
}

TEST_CASE("patches lie off their surface by as much as their digits have rounded them") {
  const Room r;
  auto set = halves(0.03);
  CHECK(match_patches(set, *r.light).n_orphans > 0);
  set.printed = {.decimals = 1, .digits = 2};
  const auto match = match_patches(set, *r.light);
  CHECK(match.n_orphans == 0);
  for (const auto& p : match.placed) CHECK(p.use == 0);
}

TEST_CASE("of two surfaces within reach the nearest counts") {
  // A board that hangs 5 mm in front of the wall.
  const Room r(std::string(room) +
               "Transform { translation 0 0 0.005 children Shape { geometry IndexedFaceSet { coord Coordinate { point "
               "[0 0 0, 2 0 0, 2 1 0] } coordIndex [0 1 2 -1] } } }");
  auto set = halves();
  set.printed = {.decimals = 2, .digits = 3};
  for (const auto& p : match_patches(set, *r.light).placed) CHECK(p.use == 0);
}

TEST_CASE("both sides of a sheet have places of their own, and a side without patches shows the other one") {
  const Room r(
      "#VRML V2.0 utf8\nShape { appearance Appearance { material Material { } } geometry IndexedFaceSet { solid FALSE "
      "coord Coordinate { "
      "point [0 0 0, 2 0 0, 2 1 0, 0 1 0] } coordIndex [0 1 2 3 -1] } }");
  auto set = halves();
  const auto fronts = patch_lightmap(set, *r.light, {}).shapes.at(0);
  CHECK(fronts.n_polygons == 1);
  CHECK(fronts.back == fronts.front);
  const auto n = set.patches.size();
  for (std::size_t i = 0; i < n; ++i) {
    Patch p = set.patches[i];
    p.back = true;
    for (float& c : p.rgb) c = 1 - c / 2;
    set.patches.push_back(p);
  }
  const auto both = patch_lightmap(set, *r.light, {.picture = {.texel = 0.05}}).shapes.at(0);
  CHECK(both.n_polygons == 2);
  // The lower left corner of the wall, from either side.
  auto color = [&](const std::array<float, 2>& place) { return at(both, place[0], place[1]); };
  CHECK(color(both.front[0][0]) == Approx(0.25));
  CHECK(color(both.back[0][0]) == Approx(1 - 0.25 / 2));
  CHECK(both.front[0][0][0] < both.front[0][1][0]);
  CHECK(both.back[0][0][0] > both.back[0][1][0]);  // seen from behind it is on the right
}

TEST_CASE("what has no patch: in a polygon as those around it, elsewhere the mean") {
  const Room r(std::string(room) +
               "Shape { geometry IndexedFaceSet { coord Coordinate { point [5 0 0, 6 0 0, 6 1 0, 5 1 0, 5 0 1, 6 0 1, "
               "6 0 0] } coordIndex [0 1 2 3 -1 4 5 6 -1] } }");
  PatchSet set;
  set.add_shape("", PatchSet::unknown);
  set.add_loose_triangle();
  set.patches.push_back({{Vec3{5, 0, 0}, Vec3{5.2, 0, 0}, Vec3{5, 1, 0}}, {0.25, 0.25, 0.25}});
  set.patches.push_back({{Vec3{5, 0.8, 0}, Vec3{5.2, 0.8, 0}, Vec3{5, 1, 0}}, {0.75, 0.75, 0.75}});
  const auto lightmap = patch_lightmap(set, *r.light, {.picture = {.texel = 0.02}});
  CHECK(lightmap.n_bare == 1);
  const auto& s = lightmap.shapes.at(0);
  REQUIRE(s.front.size() == 3);
  auto color = [&](const std::array<float, 2>& place) { return at(s, place[0], place[1]); };
  CHECK(color(s.front[0][1]) == Approx(0.25));  // the lower right corner of the wall
  for (const auto& place : s.front[2]) CHECK(color(place) == Approx(0.5).margin(1e-6));
}

TEST_CASE("colours of corners go over smooth edges and end at sharp ones") {
  auto patch = [](double tilt, double color) {
    const V3 n = unit(V3(std::sin(tilt), 0, std::cos(tilt)));
    return MeetingPatch{{V3(0, 0, 0), V3(std::cos(tilt), 0, -std::sin(tilt)), V3(0, 1, 0)}, {n, n, n}, V3(color)};
  };
  const std::vector<MeetingPatch> smooth = {patch(0, 1), patch(0.1, 3)}, sharp = {patch(0, 1), patch(1.5, 3)};
  CHECK(smooth_colors(smooth)[0][0].x == Approx(2));
  CHECK(smooth_colors(smooth)[0][1].x == Approx(1));
  CHECK(smooth_colors(sharp)[0][0].x == Approx(1));
  // No area, no colour but its own.
  const std::vector<MeetingPatch> none = {{{V3(1), V3(1), V3(1)}, {}, V3(0.5)}};
  CHECK(smooth_colors(none)[0][2].x == 0.5);
}

TEST_CASE("patches that lie on nothing are counted") {
  const Room r;
  auto set = halves();
  set.patches.push_back({{Vec3{0, 0, 5}, Vec3{1, 0, 5}, Vec3{0, 1, 5}}, {1, 1, 1}});
  set.patches.push_back({{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 0, 0}}, {1, 1, 1}});  // no area
  const auto lightmap = patch_lightmap(set, *r.light, {});
  CHECK(lightmap.n_patches == 4);
  CHECK(lightmap.n_orphans == 2);
  CHECK(lightmap.shapes.size() == 1);
}

TEST_CASE("a flat polygon is one picture, upright, with its corners in the corners") {
  const Room r;
  PatchLightmapOptions options{.picture = {.texel = 0.05, .border = 2}};
  const auto lightmap = patch_lightmap(halves(), *r.light, options);
  REQUIRE(lightmap.shapes.size() == 1);
  const auto& s = lightmap.shapes[0];
  CHECK(s.n_polygons == 1);
  CHECK(s.picture.width == 44);
  CHECK(s.picture.height == 24);
  CHECK(at(s, 0.25, 0.5) == Approx(0.25));
  CHECK(at(s, 0.75, 0.5) == Approx(0.75));
  CHECK(at(s, 0.001, 0.001) == Approx(0.25));  // the border goes on
  for (std::uint32_t e = 0; e < 2; ++e) {
    const auto t = triangle_of(*r.light, 0, e);
    for (std::size_t k = 0; k < 3; ++k) {
      CHECK(s.front[e][k][0] == Approx((2 + t[k].x / 0.05) / 44));
      CHECK(s.front[e][k][1] == Approx((2 + t[k].y / 0.05) / 24));
    }
  }
}

TEST_CASE("a smooth picture has at each corner the patches' colours by their angles") {
  const Room r;
  const auto lightmap = patch_lightmap(halves(), *r.light, {.picture = {.texel = 0.005}, .smooth = true});
  const auto& s = lightmap.shapes.at(0);
  // At the foot of the middle the left half has a right angle, the right half has two of 45 degrees: as much.
  // Between corners colours are linear: 1 % of the width, or a texel, off a corner is 0.005.
  CHECK(at(s, 0.5, 0.01) == Approx(0.5).margin(0.005));
  CHECK(at(s, 0.5, 0.99) == Approx(0.5).margin(0.005));
  CHECK(at(s, 0.01, 0.5) == Approx(0.25).margin(0.005));
  CHECK(at(s, 0.99, 0.5) == Approx(0.75).margin(0.005));
  for (double x : {0.1, 0.25, 0.3, 0.4, 0.6, 0.75, 0.9}) CHECK(at(s, x, 0.5) == Approx(0.25 + 0.5 * x).margin(0.005));
}

TEST_CASE("without the surface's colour a picture holds what a white surface would reflect") {
  const Room r;
  PatchLightmapOptions options{.picture = {.texel = 0.05}};
  options.without_color = true;
  const auto s = patch_lightmap(halves(), *r.light, options).shapes.at(0);
  CHECK(at(s, 0.25, 0.5) == Approx((0.25 - linear(0.1)) / linear(0.5)));
}

TEST_CASE("pictures are no larger than they may be") {
  const Room r;
  const auto s = patch_lightmap(halves(), *r.light, {.picture = {.texel = 1e-5}, .most_side = 256}).shapes.at(0);
  CHECK(s.picture.width <= 256);
  CHECK(s.picture.width > 128);
}
