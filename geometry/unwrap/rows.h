// Which cells of the unit grid a triangle touches, row by row: for masks of texels and for finding what lies near.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/unwrap/charts.h"

namespace wrlkit::unwrap {

using Triangle2 = std::array<Point2, 3>;

/// Calls f(y, first, last) for each row; the cells are first to last. What a triangle has beyond a cell's border by
/// less than a thousandth does not count: that is rounding, and would cost a row of texels.
template <class F>
void for_each_touched_row(const Triangle2& t, F&& f) {
  constexpr double slack = 1e-3;
  auto cells = [](double low, double high) {
    double middle = (low + high) / 2;
    return std::pair{static_cast<int>(std::floor(std::min(low + slack, middle))),
                     static_cast<int>(std::floor(std::max(high - slack, middle)))};
  };
  auto [y0, y1] = cells(std::min({t[0].y, t[1].y, t[2].y}), std::max({t[0].y, t[1].y, t[2].y}));
  if (y0 == y1) {
    auto [x0, x1] = cells(std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}));
    f(y0, x0, x1);
    return;
  }
  for (int y = y0; y <= y1; ++y) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int k = 0; k < 3; ++k) {
      Point2 a = t[k], b = t[k == 2 ? 0 : k + 1];
      if (a.y > b.y) std::swap(a, b);
      if (b.y < y || a.y > y + 1) continue;
      double slope = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0;
      double from = a.y >= y ? a.x : a.x + slope * (y - a.y), to = b.y <= y + 1 ? b.x : a.x + slope * (y + 1 - a.y);
      low = std::min({low, from, to});
      high = std::max({high, from, to});
    }
    if (low > high) continue;
    auto [x0, x1] = cells(low, high);
    f(y, x0, x1);
  }
}

}  // namespace wrlkit::unwrap
