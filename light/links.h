// How much of the light that each cell gathers arrives in each other one: a sparse matrix, and what all cells have in
// the end, after any number of reflections.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "light/color.h"

namespace wrlkit::light {

/// A share of what another cell gathers.
struct Link {
  std::uint32_t from;
  float share[3];  // red, green, blue
};

/// What a cell gathers: what does not depend on other cells, and shares of what those gather.
struct LinkedCell {
  V3 first;
  std::vector<Link> links;

  void link(std::uint32_t from, const V3& share);
  /// Links from one cell become one.
  void merge();
};

/// light[c] = first[c] + the sum of share * light[from] (BiCGSTAB; van der Vorst 1992): to a ten-thousandth, or, where
/// there is no such light, since more is reflected than arrives, that of 20 reflections. Never negative. O(links) a
/// step, of which some ten are taken.
std::vector<V3> solve(std::span<const LinkedCell> cells);

}  // namespace wrlkit::light
