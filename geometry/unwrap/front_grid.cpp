#include "geometry/unwrap/front_grid.h"

#include <bit>

namespace wrlkit::unwrap {
namespace {

/// Whether one of the sides of `a` has all of `b` beyond it. Touching is not overlap, nor is what rounding makes of it.
bool parted_by_side(const Triangle2& a, const Triangle2& b) {
  constexpr double slack = 1e-4;
  for (int k = 0; k < 3; ++k) {
    Point2 side = a[k == 2 ? 0 : k + 1] - a[k];
    double limit = slack * dot(side, side);
    if (cross(side, b[0] - a[k]) <= limit && cross(side, b[1] - a[k]) <= limit && cross(side, b[2] - a[k]) <= limit)
      return true;
  }
  return false;
}

}  // namespace

bool overlap(const Triangle2& a, const Triangle2& b) {
  auto apart = [&](double Point2::*axis) {
    return std::min({a[0].*axis, a[1].*axis, a[2].*axis}) >= std::max({b[0].*axis, b[1].*axis, b[2].*axis}) ||
           std::min({b[0].*axis, b[1].*axis, b[2].*axis}) >= std::max({a[0].*axis, a[1].*axis, a[2].*axis});
  };
  return !apart(&Point2::x) && !apart(&Point2::y) && !parted_by_side(a, b) && !parted_by_side(b, a);
}

void FrontGrid::reset(double cell, std::size_t n) {
  scale_ = 1 / cell;
  const int bits = std::max(4, static_cast<int>(std::bit_width(n)));
  shift_ = 32 - bits;
  head_.assign(std::size_t{1} << bits, end);
  entries_.clear();
  asked_.assign(n, 0);
  query_ = 0;
}

void FrontGrid::insert(const Triangle2& t, std::uint32_t name) {
  if (name >= asked_.size()) asked_.resize(2 * std::size_t{name} + 1, 0);
  for_each_touched_row(scaled(t), [&](int y, int x0, int x1) {
    for (int x = x0; x <= x1; ++x) {
      std::uint32_t& head = head_[bucket(x, y)];
      entries_.push_back({name, head});
      head = static_cast<std::uint32_t>(entries_.size() - 1);
    }
  });
}

}  // namespace wrlkit::unwrap
