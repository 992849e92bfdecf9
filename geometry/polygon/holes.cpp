// A bridge goes from the leftmost point of a hole to a corner of the outline that it can see. Straight to the left of
// that point lies an edge of the outline; its left end can be seen unless a corner is in between, and then the one
// closest to the straight line can. Holes are joined from left to right, so that a hole in between is part of the
// outline already.
#include "geometry/polygon/holes.h"

#include <algorithm>

namespace wrlkit {
namespace {

constexpr std::uint32_t none = 0xffffffffu;

class Bridges {
 public:
  Bridges(Rings& rings, std::uint32_t outline) : rings_(rings), outline_(outline) {}

  std::uint32_t leftmost(std::uint32_t ring) const {
    auto best = ring;
    each(ring, [&](std::uint32_t n) {
      if (rings_.at[n] < rings_.at[best]) best = n;
    });
    return best;
  }

  void join(std::uint32_t hole) {
    auto to = find(rings_.at[hole]);
    if (to == none) return;
    auto to_again = rings_.add(rings_.nodes[to].point, rings_.at[to]);
    auto hole_again = rings_.add(rings_.nodes[hole].point, rings_.at[hole]);
    rings_.link(to_again, rings_.after(to));
    rings_.link(rings_.before(hole), hole_again);
    rings_.link(hole_again, to_again);
    rings_.link(to, hole);
  }

 private:
  template <class F>
  void each(std::uint32_t start, F f) const {
    auto n = start;
    do {
      f(n);
      n = rings_.after(n);
    } while (n != start);
  }

  /// The node at which a bridge from `p` can end.
  std::uint32_t find(const Vec2& p) const {
    double x = 0;
    auto end = left_end(p, x);
    if (end == none) return none;
    const Vec2 corner = rings_.at[end], hit{x, p[1]};
    auto best = end;
    bool best_open = opens_to(end, p);
    each(outline_, [&](std::uint32_t n) {
      const Vec2& q = rings_.at[n];
      if (n == end || q[0] < corner[0] || q[0] > p[0] || !in_triangle(q, p, hit, corner) || !opens_to(n, p)) return;
      if (!best_open || closer(q, rings_.at[best], p)) {
        best = n;
        best_open = true;
      }
    });
    return best;
  }

  /// The left end of the edge that lies straight to the left of p, and where it is hit.
  std::uint32_t left_end(const Vec2& p, double& x) const {
    auto best = none;
    each(outline_, [&](std::uint32_t n) {
      const Vec2 &a = rings_.at[n], &b = rings_.at[rings_.after(n)];
      if (!(a[1] >= p[1] && p[1] >= b[1]) || a[1] == b[1]) return;  // the inside is on the right of edges that go down
      double hit = p[1] == a[1] ? a[0] : p[1] == b[1] ? b[0] : a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
      if (hit > p[0] || (best != none && hit <= x)) return;
      x = hit;
      best = p[1] == a[1] ? n : p[1] == b[1] || b[0] < a[0] ? rings_.after(n) : n;
    });
    return best;
  }

  static bool in_triangle(const Vec2& q, const Vec2& a, const Vec2& b, const Vec2& c) {
    double ab = orientation(a, b, q), bc = orientation(b, c, q), ca = orientation(c, a, q);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
  }

  /// Whether a line from the node to p begins inside the polygon.
  bool opens_to(std::uint32_t n, const Vec2& p) const {
    double in = orientation(rings_.at[rings_.before(n)], rings_.at[n], p);
    double out = orientation(rings_.at[n], rings_.at[rings_.after(n)], p);
    return rings_.turn(n) > 0 ? in >= 0 && out >= 0 : in >= 0 || out >= 0;
  }

  /// By the angle to the horizontal, then by the distance.
  static bool closer(const Vec2& a, const Vec2& b, const Vec2& p) {
    double ay = std::abs(a[1] - p[1]) * (p[0] - b[0]), by = std::abs(b[1] - p[1]) * (p[0] - a[0]);
    return ay != by ? ay < by : a[0] > b[0];
  }

  Rings& rings_;
  std::uint32_t outline_;
};

}  // namespace

void join_holes(Rings& rings, std::uint32_t outline, std::span<const std::uint32_t> holes) {
  Bridges bridges(rings, outline);
  std::vector<std::uint32_t> left;
  for (auto hole : holes) left.push_back(bridges.leftmost(hole));
  std::ranges::stable_sort(left, [&](auto a, auto b) { return rings.at[a] < rings.at[b]; });
  for (auto hole : left) bridges.join(hole);
}

}  // namespace wrlkit
