// A grid of cells over space of which only those in use exist: hashing. A cell is named by the three whole numbers that
// coordinates give when divided by its size; they stay doubles, so that nothing overflows.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "passes/weld/value_table.h"

namespace wrlkit {

/// Entries by cell and level. Those of another cell may be met as well, should the hashes agree.
class CellGrid {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  void start(std::size_t n_expected) {
    heads_.assign(std::bit_ceil(n_expected + 8), none);
    entries_.clear();
  }
  void add(const std::array<double, 3>& cell, std::uint32_t what, double level = 0) {
    if (entries_.size() > heads_.size()) grow();
    std::uint64_t h = hash(cell, level);
    std::uint32_t& head = heads_[h & (heads_.size() - 1)];
    entries_.push_back({what, head, h});
    head = static_cast<std::uint32_t>(entries_.size() - 1);
  }
  /// Calls f(what) for the entries of a cell, the last one first.
  template <class F>
  void visit(const std::array<double, 3>& cell, F f, double level = 0) const {
    std::uint64_t h = hash(cell, level);
    for (std::uint32_t e = heads_[h & (heads_.size() - 1)]; e != none; e = entries_[e].next)
      if (entries_[e].hash == h) f(entries_[e].what);
  }

 private:
  struct Entry {
    std::uint32_t what, next;
    std::uint64_t hash;
  };

  static std::uint64_t hash(const std::array<double, 3>& cell, double level) {
    std::uint64_t h = bits_of(level);
    for (double c : cell) h = mix(std::rotl(h, 23) * 0x9e3779b97f4a7c15u ^ bits_of(c));
    return h;
  }
  void grow() {
    heads_.assign(2 * heads_.size(), none);
    for (std::uint32_t e = 0; e < entries_.size(); ++e) {
      std::uint32_t& head = heads_[entries_[e].hash & (heads_.size() - 1)];
      entries_[e].next = head;
      head = e;
    }
  }

  std::vector<std::uint32_t> heads_;  // a power of two
  std::vector<Entry> entries_;
};

/// Calls f(cell) for the cells of a size that the box from `low` to `high` meets, if it is not larger than a cell:
/// eight at most.
template <class F>
void for_each_cell(const std::array<double, 3>& low, const std::array<double, 3>& high, double size, F f) {
  std::array<double, 3> ends[2];
  for (int i = 0; i < 3; ++i) {
    ends[0][i] = std::floor(low[i] / size);
    ends[1][i] = std::floor(high[i] / size);
  }
  for (int k = 0; k < 8; ++k) {
    std::array<double, 3> cell;
    bool again = false;  // the box does not leave its cell in this direction
    for (int i = 0; i < 3; ++i) {
      int end = k >> i & 1;
      cell[i] = ends[end][i];
      again |= end == 1 && ends[0][i] == ends[1][i];
    }
    if (!again) f(cell);
  }
}

}  // namespace wrlkit
