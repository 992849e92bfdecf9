#include "geometry/unwrap/turn.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::unwrap {
namespace {

constexpr std::size_t most_directions = 48;  // of a hull with more sides, the longest are tried

struct Box {
  double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
  double width() const { return x1 - x0; }
  double height() const { return y1 - y0; }
};
Point2 turned(Point2 p, Point2 direction) { return {dot(p, direction), cross(direction, p)}; }

Box box_of(const std::vector<Point2>& points, Point2 direction) {
  Box b;
  for (Point2 p : points) {
    Point2 q = turned(p, direction);
    b.x0 = std::min(b.x0, q.x);
    b.x1 = std::max(b.x1, q.x);
    b.y0 = std::min(b.y0, q.y);
    b.y1 = std::max(b.y1, q.y);
  }
  return b;
}

}  // namespace

/// By Andrew's monotone chain (1979), counter-clockwise.
void Turner::make_hull(const std::vector<Point2>& points) {
  sorted_ = points;
  std::sort(sorted_.begin(), sorted_.end(), [](Point2 a, Point2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  hull_.clear();
  for (int half = 0; half < 2; ++half) {
    std::size_t base = hull_.size();
    for (Point2 p : sorted_) {
      while (hull_.size() >= base + 2 && cross(hull_.back() - hull_[hull_.size() - 2], p - hull_.back()) <= 0)
        hull_.pop_back();
      hull_.push_back(p);
    }
    hull_.pop_back();
    std::reverse(sorted_.begin(), sorted_.end());
  }
}

Point2 Turner::turn(std::vector<Point2>& points) {
  make_hull(points);
  std::vector<Point2> sides;
  for (std::size_t i = 0; i < hull_.size(); ++i) sides.push_back(hull_[(i + 1) % hull_.size()] - hull_[i]);
  if (sides.size() > most_directions) {
    auto longer = [](Point2 a, Point2 b) { return dot(a, a) > dot(b, b); };
    std::stable_sort(sides.begin(), sides.end(), longer);
    sides.resize(most_directions);
  }
  Point2 best{1, 0};
  Box box = box_of(hull_, best);
  for (Point2 side : sides) {
    double l = std::sqrt(dot(side, side));
    if (!(l > 0)) continue;
    Box b = box_of(hull_, (1 / l) * side);
    if (b.width() * b.height() < box.width() * box.height() * (1 - 1e-9)) {
      box = b;
      best = (1 / l) * side;
    }
  }
  if (box.height() > box.width()) best = {-best.y, best.x};
  box = box_of(points, best);
  for (Point2& p : points) p = turned(p, best) - Point2{box.x0, box.y0};
  return {box.width(), box.height()};
}

}  // namespace wrlkit::unwrap
