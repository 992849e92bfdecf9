// Points of the plane in a tree of boxes, each point live or not: which live points may lie in a triangle. The tree
// halves the points and not the plane, so that points that crowd in one place cost no more than points that do not.
#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "scenegraph/value.h"

namespace wrlkit {

class PointTree {
 public:
  /// Takes the points; none is live. O(n log n). Memory is kept for the next use.
  void build(std::span<const Vec2> points);
  bool live(std::uint32_t point) const { return live_[point]; }
  void set_live(std::uint32_t point, bool live);

  /// Whether test(point) is true for any live point that may lie in the anticlockwise triangle, or within `margin` of
  /// it (a part of its size). Points that are farther away are tested too when they share a box with nearer ones. What
  /// was looked at, boxes and points, is added to `effort`.
  template <class Test>
  bool any(const Vec2& a, const Vec2& b, const Vec2& c, double margin, std::size_t& effort, Test test) const;

 private:
  struct Box {
    Vec2 low, high;
    std::uint32_t n_live;
  };
  /// The points that are on the left of a line, and a little more.
  struct HalfPlane {
    HalfPlane(const Vec2& from, const Vec2& to, double margin);
    bool meets(const Box&) const;
    Vec2 from;
    double dx, dy, slack;
  };
  Box box_around(std::uint32_t begin, std::uint32_t end) const;
  std::uint32_t begin_of(std::uint32_t box, int level) const {
    return static_cast<std::uint32_t>((std::uint64_t{box} * order_.size()) >> level);
  }

  std::span<const Vec2> points_;
  std::vector<std::uint32_t> order_;    // points, by leaf
  std::vector<std::uint32_t> leaf_of_;  // per point
  std::vector<Box> boxes_;              // the root, its two halves, their four, ...
  std::vector<std::uint8_t> live_;      // per point
  int levels_ = 0;                      // of boxes below the root
};

inline PointTree::HalfPlane::HalfPlane(const Vec2& a, const Vec2& b, double margin)
    : from(a), dx(b[0] - a[0]), dy(b[1] - a[1]), slack(margin * (dx * dx + dy * dy)) {}

inline bool PointTree::HalfPlane::meets(const Box& box) const {
  double x = (dy > 0 ? box.low : box.high)[0] - from[0], y = (dx > 0 ? box.high : box.low)[1] - from[1];
  double left = dx * y, right = dy * x;
  return left - right >= -slack - 1e-15 * (std::abs(left) + std::abs(right));
}

template <class Test>
bool PointTree::any(const Vec2& a, const Vec2& b, const Vec2& c, double margin, std::size_t& effort, Test test) const {
  const HalfPlane sides[] = {{a, b, margin}, {b, c, margin}, {c, a, margin}};
  std::uint32_t stack[64], n = 0;
  stack[n++] = 0;
  std::uint32_t first_leaf = (1u << levels_) - 1;
  while (n) {
    std::uint32_t at = stack[--n];
    const Box& box = boxes_[at];
    ++effort;
    if (!box.n_live || !sides[0].meets(box) || !sides[1].meets(box) || !sides[2].meets(box)) continue;
    if (at < first_leaf) {
      stack[n++] = 2 * at + 2;
      stack[n++] = 2 * at + 1;
      continue;
    }
    effort += box.n_live;
    for (auto i = begin_of(at - first_leaf, levels_); i < begin_of(at - first_leaf + 1, levels_); ++i)
      if (live_[order_[i]] && test(order_[i])) return true;
  }
  return false;
}

}  // namespace wrlkit
