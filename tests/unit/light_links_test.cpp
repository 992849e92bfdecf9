// What cells gather of one another in the end (light/links.h), where it is known.
#include <catch2/catch.hpp>
#include <cmath>

#include "light/links.h"

namespace wrlkit::light {
namespace {

/// A ring of cells, each of which reflects to the next one; light comes to the first.
std::vector<LinkedCell> ring(std::uint32_t n, const V3& albedo) {
  std::vector<LinkedCell> cells(n);
  cells[0].first = V3(1);
  for (std::uint32_t c = 0; c < n; ++c) cells[(c + 1) % n].link(c, albedo);
  return cells;
}

TEST_CASE("light that goes around a ring is the sum of a geometric series", "[light]") {
  constexpr int n = 50;
  const auto light = solve(ring(n, {0.5, 0.99, 0.999}));
  for (int c = 0; c < n; c += 7) {
    CHECK(light[static_cast<std::size_t>(c)].y == Approx(std::pow(0.99, c) / (1 - std::pow(0.99, n))).epsilon(1e-3));
    CHECK(light[static_cast<std::size_t>(c)].z == Approx(std::pow(0.999, c) / (1 - std::pow(0.999, n))).epsilon(1e-3));
  }
  CHECK(light[0].x == Approx(1).epsilon(1e-3));
}

TEST_CASE("a room that lets hardly any light out is as bright as it is in the end", "[light]") {
  constexpr std::uint32_t n = 300;
  std::vector<LinkedCell> cells(n);
  for (std::uint32_t c = 0; c < n; ++c) {
    cells[c].first = V3(c == 0 ? n : 0);
    for (std::uint32_t from = 0; from < n; ++from) cells[c].link(from, V3(0.98 / n));
    cells[c].merge();
  }
  // The mean m is 1 + 0.98 m; where light comes directly there is that on top.
  const auto light = solve(cells);
  CHECK(light[n - 1].x == Approx(0.98 * 50).epsilon(1e-3));
  CHECK(light[0].x == Approx(n + 0.98 * 50).epsilon(1e-3));
}

TEST_CASE("what reflects more than arrives has bounded light, never negative", "[light]") {
  for (const double albedo : {1.0, 1.01})
    for (const std::uint32_t n : {2u, 64u, 100u})
      for (const V3& v : solve(ring(n, V3(albedo)))) {
        CHECK(v.x >= 0);
        CHECK(v.x <= 1000);
      }
  CHECK(solve({}).empty());
}

TEST_CASE("links from one cell are merged", "[light]") {
  LinkedCell cell;
  cell.link(3, {0.25, 0, 0});
  cell.link(1, {0.5, 0, 0});
  cell.link(3, {0.125, 0.5, 0});
  cell.merge();
  REQUIRE(cell.links.size() == 2);
  CHECK(cell.links[0].from == 1);
  CHECK(cell.links[1].share[0] == 0.375f);
  CHECK(cell.links[1].share[1] == 0.5f);
}

}  // namespace
}  // namespace wrlkit::light
