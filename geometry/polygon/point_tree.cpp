#include "geometry/polygon/point_tree.h"

#include <algorithm>
#include <numeric>

namespace wrlkit {
namespace {

constexpr std::size_t leaf_size = 4;
constexpr std::size_t few = 16;  // points that are looked through faster than sorted

}  // namespace

PointTree::Box PointTree::box_around(std::uint32_t begin, std::uint32_t end) const {
  if (begin == end) return {{0, 0}, {0, 0}, 0};
  Box b{points_[order_[begin]], points_[order_[begin]], 0};
  for (auto i = begin + 1; i < end; ++i)
    for (int k = 0; k < 2; ++k) {
      b.low[k] = std::min(b.low[k], points_[order_[i]][k]);
      b.high[k] = std::max(b.high[k], points_[order_[i]][k]);
    }
  return b;
}

void PointTree::build(std::span<const Vec2> points) {
  points_ = points;
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  live_.assign(points.size(), 0);
  leaf_of_.resize(points.size());
  for (levels_ = 0; points.size() > few && (points.size() >> levels_) > leaf_size;) ++levels_;
  boxes_.clear();
  for (int level = 0; level <= levels_; ++level)
    for (std::uint32_t k = 0; k < 1u << level; ++k) {
      auto begin = begin_of(k, level), end = begin_of(k + 1, level);
      const Box& box = boxes_.emplace_back(box_around(begin, end));
      if (level == levels_) {
        for (auto i = begin; i < end; ++i) leaf_of_[order_[i]] = k;
        continue;
      }
      int axis = box.high[0] - box.low[0] < box.high[1] - box.low[1];
      auto before = [&](std::uint32_t i, std::uint32_t j) { return points_[i][axis] < points_[j][axis]; };
      std::nth_element(order_.begin() + begin, order_.begin() + begin_of(2 * k + 1, level + 1), order_.begin() + end,
                       before);
    }
}

void PointTree::set_live(std::uint32_t point, bool live) {
  if (live_[point] == live) return;
  live_[point] = live;
  std::uint32_t step = live ? 1u : ~0u;
  for (std::uint32_t at = leaf_of_[point] + (1u << levels_) - 1;; at = (at - 1) / 2) {
    boxes_[at].n_live += step;
    if (at == 0) return;
  }
}

}  // namespace wrlkit
