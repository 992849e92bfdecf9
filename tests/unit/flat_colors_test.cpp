// Levels of parts with colours for whole faces: where colours meet counts as the form does.
#include "geometry/flat_colors.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/closest_of_label.h"
#include "geometry/deviation.h"
#include "geometry/simplify/ladder.h"
#include "geometry/simplify/levels.h"

using namespace wrlkit;

namespace {

/// A sheet of 2 n * n triangles over [0, 1] in x and y, red where x is less than `border`, blue elsewhere.
Mesh sheet(std::uint32_t n, double border) {
  Mesh m;
  m.kind = Mesh::Kind::faces;
  m.color.values = {1, 0, 0, 0, 0, 1};
  auto& points = m.positions.edit();
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t k = 0; k <= n; ++k) {
      points.insert(points.end(), {double(i) / n, double(k) / n, 0});
      if (i == n || k == n) continue;
      const auto at = i * (n + 1) + k;
      m.corners.insert(m.corners.end(), {at, at + n + 1, at + 1, at + 1, at + n + 1, at + n + 2});
      m.color.index.insert(m.color.index.end(), 6, i < border * n ? 0 : 1);
    }
  return m;
}

double measured(const Mesh& level, const Mesh& first) {
  const auto colors = FlatColors::of(first);
  const auto regions = colors->regions_of(level);
  return measure_labeled({triangles_of(level), regions}, {triangles_of(first), colors->regions()}, colors->n_regions())
      .max;
}

}  // namespace

TEST_CASE("flat colors: regions are colours of whole faces", "[levels]") {
  Mesh m = sheet(4, 0.5);
  const auto colors = FlatColors::of(m);
  REQUIRE(colors);
  CHECK(colors->n_regions() == 2);
  CHECK(colors->regions()[0] != colors->regions()[31]);
  SECTION("a colour that was not there is none") {
    m.color.values[0] = 0.5F;
    CHECK(colors->regions_of(m)[0] == FlatColors::none);
    CHECK(colors->regions_of(m)[31] == colors->regions()[31]);
  }
  SECTION("one colour is nothing to be told apart") { CHECK_FALSE(FlatColors::of(sheet(4, 0))); }
  SECTION("colours of vertices are those of regions, and blend where these meet") {
    m.color.index[0] = 1;
    const auto blended = FlatColors::of(m);
    REQUIRE(blended);
    CHECK(blended->blends());
    CHECK(std::ranges::equal(blended->regions(), colors->regions()));
    const auto whole = with_whole_faces(m);
    REQUIRE(whole);
    CHECK(std::ranges::equal(colors->regions_of(*whole), colors->regions()));
    CHECK_FALSE(with_whole_faces(*whole));
  }
  SECTION("a colour that no whole face has blends smoothly") {
    m.color.values.insert(m.color.values.end(), {0.5, 0.5, 0.5});
    m.color.index[0] = 2;
    CHECK_FALSE(FlatColors::of(m));
  }
  SECTION("faces of one colour are the exception where colours blend") {
    for (std::size_t c = 0; c < m.color.index.size(); c += 3) m.color.index[c] = c < 54 ? m.color.index[c] : 0;
    for (std::size_t c = 0; c < m.color.index.size(); c += 3) m.color.index[c + 1] = 1;
    CHECK_FALSE(FlatColors::of(m));
  }
  SECTION("painted faces have it again") {
    Mesh bare = m;
    bare.color.clear();
    colors->paint(bare, colors->regions());
    CHECK(std::ranges::equal(colors->regions_of(bare), colors->regions()));
  }
  SECTION("thousands of colours are few regions") {
    Mesh many = sheet(40, 0.5);
    many.color.values.clear();
    for (std::uint32_t f = 0; f < many.n_faces(); ++f) {
      const auto x = static_cast<float>(f) / static_cast<float>(many.n_faces());
      many.color.values.insert(many.color.values.end(), {x, 1 - x, x * x});
      for (std::size_t k = 0; k < 3; ++k) many.color.index[std::size_t{3} * f + k] = f;
    }
    const auto few = FlatColors::of(many);
    REQUIRE(few);
    CHECK(few->n_regions() > 8);
    CHECK(few->n_regions() <= FlatColors::most_regions);
  }
}

TEST_CASE("flat colors: a border that has moved is as far off as it has moved", "[levels]") {
  const Mesh first = sheet(10, 0.5);
  CHECK(measured(first, first) == 0);
  CHECK(measured(sheet(4, 0.5), first) == Approx(0).margin(1e-9));
  CHECK(measured(sheet(4, 0.75), first) == Approx(0.25).margin(1e-6));
  CHECK(measured(sheet(4, 0.25), first) == Approx(0.25).margin(1e-6));
  // Only the colours are other ones.
  Mesh turned = first;
  for (auto& i : turned.color.index) i = 1 - i;
  CHECK(measured(turned, first) == Approx(0.5).margin(0.02));
}

TEST_CASE("flat colors: what is nearest has the label that is asked for", "[levels]") {
  const Mesh m = sheet(10, 0.5);
  const auto colors = FlatColors::of(m);
  const ClosestOfLabel closest(triangles_of(m), colors->regions(), 2);
  const auto red = colors->regions()[0], blue = 1 - red;
  const Vec3 p{0.2, 0.5, 0.4};
  CHECK(closest.nearest(p, {}, red).distance == Approx(0.4));
  const auto found = closest.nearest(p, {}, blue);
  CHECK(found.distance == Approx(0.5));
  CHECK(closest.label(found.triangle) == blue);
  CHECK(closest.nearest(p, {}, blue, 0).triangle == closest.nearest(p, {}, blue).triangle);  // a guess of another label
  CHECK(closest.distance_of_others(p, red) == Approx(0.5));
  CHECK(std::isinf(closest.nearest(p, {}, 2).distance));
}

TEST_CASE("flat colors: a ladder keeps a band, and says how far its borders have moved", "[levels]") {
  // A tube around y, 48 by 40, with a band.
  Mesh tube;
  tube.kind = Mesh::Kind::faces;
  tube.solid = false;
  tube.color.values = {1, 1, 1, 1, 0, 0};
  constexpr std::uint32_t n = 48, rows = 40;
  auto& points = tube.positions.edit();
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t i = 0; i < n; ++i) {
      const double angle = 2 * 3.14159265358979 * i / n;
      points.insert(points.end(), {std::cos(angle), 0.1 * row, -std::sin(angle)});
      if (row == rows) continue;
      const auto at = row * n + i, next = row * n + (i + 1) % n;
      tube.corners.insert(tube.corners.end(), {at, next, at + n, next, next + n, at + n});
      tube.color.index.insert(tube.color.index.end(), 6, row >= 14 && row < 20 ? 1 : 0);
    }
  const auto samples = simplify::sample_surface(triangles_of(tube), 8000);
  const auto rungs = simplify::make_ladder({tube, samples, {}, 1});
  REQUIRE(rungs.size() > 10);
  for (const auto& rung : rungs) {
    if (rung.mesh.corners.empty()) continue;
    CAPTURE(rung.n_faces);
    const auto colors = FlatColors::of(tube);
    for (const auto region : colors->regions_of(rung.mesh)) REQUIRE(region != FlatColors::none);
    CHECK(measured(rung.mesh, tube) <= 1.7 * rung.distortion.max + 1e-9);
    if (rung.n_faces >= 60) CHECK(measured(rung.mesh, tube) < 0.15);
  }
}

TEST_CASE("flat colors: levels within an error keep the borders of colours within it", "[levels]") {
  Mesh disc = sheet(40, 0.5);  // flat: nothing but the border holds a level back
  for (std::size_t f = 0; f < disc.n_faces(); ++f) {
    const Vec3 p = disc.position(disc.corners[3 * f]);
    const bool inside = std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.3;
    for (std::size_t k = 0; k < 3; ++k) disc.color.index[3 * f + k] = inside ? 0 : 1;
  }
  const auto levels = make_levels(disc, {.errors = {0.02, 0.05}});
  REQUIRE(levels.size() == 2);
  for (const auto& level : levels) {
    CHECK(level.error <= 0.05);
    CHECK(measured(level.mesh, disc) <= level.error * 1.02 + 1e-9);
  }
  CHECK(levels[1].error > 0.02);
}
