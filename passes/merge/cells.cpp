#include "passes/merge/cells.h"

#include <algorithm>
#include <map>
#include <queue>

#include "base/math/box.h"

namespace wrlkit {
namespace {

using Cell = std::vector<std::uint32_t>;

class Halving {
 public:
  Halving(std::span<const CellItem> items, std::size_t budget, double least)
      : items_(items), budget_(budget), least_(least) {}

  std::vector<Cell> run() {
    std::map<std::uint32_t, Cell> kinds;
    for (std::uint32_t i = 0; i < items_.size(); ++i) kinds[items_[i].kind].push_back(i);
    std::size_t cost = 0;
    for (auto& [kind, cell] : kinds) {
      cost += items_[cell[0]].cost;
      add(std::move(cell));
    }
    while (!heaviest_.empty()) {
      const auto c = heaviest_.top().second;
      heaviest_.pop();
      const auto more = items_[cells_[c][0]].cost;
      if (more == 0 || cost + more > budget_) continue;
      cost += more;
      halve(c);
    }
    std::ranges::sort(cells_, {}, [](const Cell& c) { return c[0]; });
    return std::move(cells_);
  }

 private:
  void add(Cell cell) {
    cells_.push_back(std::move(cell));
    remember(cells_.size() - 1);
  }

  void remember(std::size_t c) {
    if (cells_[c].size() < 2) return;
    double weight = 0;
    for (auto i : cells_[c]) weight += items_[i].weight;
    if (weight >= least_) heaviest_.push({{weight, -static_cast<std::int64_t>(c)}, c});
  }

  void halve(std::size_t c) {
    Cell& cell = cells_[c];
    Box box;
    for (auto i : cell) box.add(items_[i].at);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (box.size(k) > box.size(axis)) axis = k;
    std::ranges::sort(cell, [&](auto a, auto b) {
      return items_[a].at[axis] != items_[b].at[axis] ? items_[a].at[axis] < items_[b].at[axis] : a < b;
    });
    const auto middle = cell.begin() + static_cast<std::ptrdiff_t>(cell.size() / 2);
    Cell upper(middle, cell.end());
    cell.erase(middle, cell.end());
    std::ranges::sort(cell);
    std::ranges::sort(upper);
    remember(c);
    add(std::move(upper));
  }

  std::span<const CellItem> items_;
  std::size_t budget_;
  double least_;
  std::vector<Cell> cells_;
  std::priority_queue<std::pair<std::pair<double, std::int64_t>, std::size_t>> heaviest_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> cells_of(std::span<const CellItem> items, std::size_t budget, double least) {
  return Halving(items, budget, least).run();
}

}  // namespace wrlkit
