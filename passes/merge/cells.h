// Which parts go together, when their number is limited: those of one kind that stand near each other.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/value.h"

namespace wrlkit {

struct CellItem {
  std::uint32_t kind;  // only parts of one kind go together
  std::uint32_t cost;  // of each cell of that kind
  Vec3 at;
  double weight;
  std::uint32_t look = 0;  // for the caller
};

/// The cells, as numbers of items in the order of the first of each: one for each kind to begin with. As long as what
/// all cost is at most `budget`, the heaviest is halved, unless it is lighter than `least`, at its median along its
/// longest side. n log n; the same for the same items.
std::vector<std::vector<std::uint32_t>> cells_of(std::span<const CellItem> items, std::size_t budget, double least = 0);

}  // namespace wrlkit
