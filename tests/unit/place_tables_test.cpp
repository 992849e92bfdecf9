// Which Shapes are left to tables of places.
#include <catch2/catch.hpp>

#include "passes/merge/place_tables.h"

using namespace wrlkit;

namespace {

/// `n` places of one geometry in one look, which is of a kind of its own.
void add(std::vector<TableItem>& to, std::uint32_t look, std::uint32_t geometry, int n, double bytes) {
  for (int i = 0; i < n; ++i) to.push_back({look, look, geometry, 0, 1, true, bytes});
}

int kept(const PlaceTables& tables) {
  int out = 0;
  for (char k : tables.kept) out += k;
  return out;
}

}  // namespace

TEST_CASE("place tables: many places of much, not few of little", "[merge]") {
  std::vector<TableItem> items;
  add(items, 1, 1, 20, 300);
  add(items, 2, 2, 3, 80);
  const auto tables = place_tables(items, 500);
  CHECK(kept(tables) == 20);
  CHECK(tables.kept.front());
  CHECK(tables.saved_draws == 19);
}

TEST_CASE("place tables: no more than the budget has draws for", "[merge]") {
  std::vector<TableItem> items;
  add(items, 1, 1, 20, 300);
  add(items, 1, 2, 20, 200);
  CHECK(kept(place_tables(items, 2)) == 20);
  CHECK(kept(place_tables(items, 3)) == 40);
}

TEST_CASE("place tables: what is left goes to the tables of another look", "[merge]") {
  std::vector<TableItem> items;
  add(items, 1, 1, 20, 80);
  CHECK(kept(place_tables(items, 500)) == 20);
  add(items, 2, 1, 4, 80);
  CHECK(kept(place_tables(items, 500)) == 24);
  // A geometry that nothing else shows needs the cell anyway.
  add(items, 2, 2, 1, 80);
  CHECK(kept(place_tables(items, 500)) == 20);
}

TEST_CASE("place tables: places that no table can say", "[merge]") {
  std::vector<TableItem> items;
  add(items, 1, 1, 20, 300);
  for (auto& i : items) i.fits = false;
  const auto tables = place_tables(items, 500);
  CHECK(tables.saved_draws == 0);
}
