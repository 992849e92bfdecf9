#include "geometry/space_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace wrlkit {
namespace {

constexpr double least_share = 0.4;    // of what a cell draws, in each of its halves
constexpr double worth_halving = 0.8;  // of the draws or bytes that there were, in the larger half

/// The number in (low, high] with the fewest binary digits.
double roundest(double low, double high) {
  if (!(low < high)) return high;
  double step = std::exp2(std::ceil(std::log2(std::max({std::abs(low), std::abs(high), high - low}))));
  if (!std::isfinite(step)) return high;
  for (;; step /= 2) {
    const double x = std::floor(high / step) * step;
    if (x > low) return x;
    if (step < 1e-3 * (high - low)) return high;
  }
}

class Cutting {
 public:
  using Pieces = std::function<const SpaceItem&(std::uint32_t)>;

  Cutting(std::size_t n, const Pieces& piece, const CellBudget& most, std::span<const LookCost> looks)
      : n_(n), piece_(piece), most_(most), looks_(looks) {}

  Cells run() {
    out_.order.resize(n_);
    std::iota(out_.order.begin(), out_.order.end(), 0u);
    out_.cells.push_back({.name = "r", .end = static_cast<std::uint32_t>(n_)});
    for (std::uint32_t i = 0; i < out_.cells.size(); ++i) cut(i);
    out_.depth = out_.cells.back().depth;  // breadth first
    return std::move(out_);
  }

 private:
  using Range = std::pair<std::uint32_t, std::uint32_t>;

  std::uint64_t drawn(Range r) const {
    std::uint64_t n = 0;
    for (auto i = r.first; i < r.second; ++i) n += piece_(out_.order[i]).n_drawn;
    return n;
  }

  /// How many times the budgets of draws and bytes: the larger of both.
  double excess(Range r) const {
    std::vector<std::uint32_t> looks;
    double bytes = 0;
    for (auto i = r.first; i < r.second; ++i) {
      const auto& piece = piece_(out_.order[i]);
      bytes += most_.packing * piece.bytes;
      if (piece.look < looks_.size()) looks.push_back(piece.look);
    }
    sort_unique(looks);
    for (auto& look : looks) {
      bytes += static_cast<double>(looks_[look].bytes);
      look = looks_[look].family;
    }
    sort_unique(looks);
    return std::max(static_cast<double>(looks.size()) / static_cast<double>(most_.draws),
                    bytes / static_cast<double>(most_.bytes));
  }

  static void sort_unique(std::vector<std::uint32_t>& v) {
    std::ranges::sort(v);
    v.erase(std::unique(v.begin(), v.end()), v.end());
  }

  void cut(std::uint32_t cell) {
    const Range all{out_.cells[cell].begin, out_.cells[cell].end};
    const auto middle = middle_of(all);
    if (!middle) return;
    for (const Range& half : {Range{all.first, *middle}, Range{*middle, all.second}}) {
      const auto quarter = middle_of(half);
      if (!quarter) {
        add(cell, half);
        continue;
      }
      add(cell, {half.first, *quarter});
      add(cell, {*quarter, half.second});
    }
  }

  /// Where it is to be halved, if it is.
  std::optional<std::uint32_t> middle_of(Range r) {
    if (r.second - r.first < 2) return std::nullopt;
    if (drawn(r) > most_.drawn) return halve(r);
    const double before = excess(r);
    if (before <= 1) return std::nullopt;
    const auto middle = halve(r);
    const double after = std::max(excess({r.first, middle}), excess({middle, r.second}));
    return after <= worth_halving * before ? std::optional(middle) : std::nullopt;
  }

  void add(std::uint32_t parent, Range r) {
    const auto& above = out_.cells[parent];
    Cell cell{.name = above.name + std::to_string(above.children.size()),
              .parent = parent,
              .depth = above.depth + 1,
              .begin = r.first,
              .end = r.second};
    out_.cells[parent].children.push_back(static_cast<std::uint32_t>(out_.cells.size()));
    out_.cells.push_back(std::move(cell));
  }

  /// Where the second half begins; neither is empty.
  std::uint32_t halve(Range r) {
    Box box;
    for (auto i = r.first; i < r.second; ++i) box.add(piece_(out_.order[i]).box.centre());
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (box.size(k) > box.size(axis)) axis = k;
    std::sort(out_.order.begin() + r.first, out_.order.begin() + r.second, [&](std::uint32_t a, std::uint32_t b) {
      const double x = middle(a, axis), y = middle(b, axis);
      return x != y ? x < y : a < b;
    });
    const auto all = static_cast<double>(drawn(r));
    const auto low = reach(r, least_share * all), high = reach(r, (1 - least_share) * all);
    const double plane = roundest(at(low - 1, axis), at(high, axis));
    auto i = low;
    while (i < high && at(i, axis) < plane) ++i;
    return i;
  }

  /// 0 where the box has no middle, because it is infinite on both sides: NaN has no order.
  double middle(std::uint32_t piece, std::size_t axis) const {
    const double x = piece_(piece).box.centre()[axis];
    return std::isnan(x) ? 0 : x;
  }
  double at(std::uint32_t i, std::size_t axis) const { return middle(out_.order[i], axis); }

  /// Where what is before draws that much, or a little more; neither side is empty.
  std::uint32_t reach(Range r, double wanted) const {
    double before = 0;
    auto i = r.first;
    while (i + 1 < r.second && before < wanted) before += piece_(out_.order[i++]).n_drawn;
    return std::max(i, r.first + 1);
  }

  std::size_t n_;
  const Pieces& piece_;
  const CellBudget& most_;
  std::span<const LookCost> looks_;
  Cells out_;
};

}  // namespace

Cells cut_into_cells(std::size_t n, const std::function<const SpaceItem&(std::uint32_t)>& piece, const CellBudget& most,
                     std::span<const LookCost> looks) {
  return Cutting(n, piece, most, looks).run();
}

}  // namespace wrlkit
