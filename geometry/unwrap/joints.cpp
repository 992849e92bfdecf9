// A joint is a line of edges along which the surface bends. On one side are either long flat pieces that have their
// short ends there, or points around which the surface is flat, many of them together: a scan has such points, too,
// here and there.
#include "geometry/unwrap/joints.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace wrlkit::unwrap {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double flat_angle = 2e-4, bent_angle = 2e-3;  // radians that are missing, or too many, around a point
constexpr std::uint32_t many = 8;                       // flat points
constexpr double slender = 3;                           // length by width
constexpr double sharp_cosine = 0.94;                   // 0.35 rad

/// Sets of positions.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }
  std::uint32_t find(std::uint32_t p) {
    while (parent_[p] != p) p = parent_[p] = parent_[parent_[p]];
    return p;
  }
  void unite(std::uint32_t p, std::uint32_t q) { parent_[find(q)] = find(p); }

 private:
  std::vector<std::uint32_t> parent_;
};

class JointFinder {
 public:
  explicit JointFinder(Links& links) : links_(links), n_corners_(3 * links.n_triangles()) { classify(); }
  void cut();

 private:
  enum Kind : char { flat, open, curved, bent };

  void classify();
  void keep_large_flats();
  bool slender_end(std::uint32_t corner) const;
  bool flat_end(std::uint32_t corner) const;
  Kind kind(std::uint32_t corner) const { return kind_[links_.position(corner)]; }

  Links& links_;
  std::uint32_t n_corners_;
  std::vector<Kind> kind_;  // of positions
};

void JointFinder::classify() {
  std::vector<float> angles(links_.n_positions(), 0);
  kind_.assign(links_.n_positions(), flat);
  for (std::uint32_t c = 0; c < n_corners_; ++c) {
    if (!links_.finite(c / 3)) continue;
    Triangle2 s = links_.shape(c / 3);
    Point2 u = s[next_corner(c) % 3] - s[c % 3], v = s[previous_corner(c) % 3] - s[c % 3];
    angles[links_.position(c)] += static_cast<float>(std::atan2(cross(u, v), dot(u, v)));
    if (links_.mate(c) == none) kind_[links_.position(c)] = kind_[links_.position(next_corner(c))] = open;
  }
  for (std::uint32_t p = 0; p < kind_.size(); ++p) {
    double missing = std::abs(angles[p] - full_turn);
    if (kind_[p] == flat && missing > flat_angle) kind_[p] = missing > bent_angle ? bent : curved;
  }
  keep_large_flats();
}

/// Those that are together by whole triangles; an elbow has lines of flat points.
void JointFinder::keep_large_flats() {
  Sets sets(kind_.size());
  for (std::uint32_t c = 0; c < n_corners_; c += 3)
    if (links_.finite(c / 3) && kind(c) == flat && kind(c + 1) == flat && kind(c + 2) == flat) {
      sets.unite(links_.position(c), links_.position(c + 1));
      sets.unite(links_.position(c), links_.position(c + 2));
    }
  std::vector<std::uint32_t> count(kind_.size(), 0);
  for (std::uint32_t p = 0; p < kind_.size(); ++p)
    if (kind_[p] == flat) ++count[sets.find(p)];
  for (std::uint32_t p = 0; p < kind_.size(); ++p)
    if (kind_[p] == flat && count[sets.find(p)] < many) kind_[p] = curved;
}

bool JointFinder::slender_end(std::uint32_t corner) const {
  std::uint32_t t = corner / 3, u = links_.mate(corner) / 3;
  Triangle2 s = links_.shape(t);
  auto squared = [&](std::uint32_t c) {
    Point2 side = s[next_corner(c) % 3] - s[c % 3];
    return dot(side, side);
  };
  std::uint32_t next = next_corner(corner), previous = previous_corner(corner);
  if (links_.area(t) < slender * squared(corner)) return false;
  std::uint32_t longest = squared(next) > squared(previous) ? next : previous;
  if (links_.mate(longest) == none || !links_.flat(longest)) return false;
  return links_.area(t) > slender * links_.area(u) || links_.cosine(t, u) < sharp_cosine;
}

bool JointFinder::flat_end(std::uint32_t corner) const {
  Kind a = kind(corner), b = kind(next_corner(corner));
  if (a == flat || b == flat || (links_.flat(corner) && (a == open || b == open))) return false;
  return kind(previous_corner(corner)) == flat && kind(previous_corner(links_.mate(corner))) != flat;
}

/// A line is cut if it bends anywhere: around an elbow there are two places where it does not.
void JointFinder::cut() {
  std::vector<std::uint32_t> edges;
  Sets lines(kind_.size());
  for (std::uint32_t c = 0; c < n_corners_; ++c)
    if (links_.mate(c) != none && (slender_end(c) || flat_end(c))) {
      edges.push_back(c);
      lines.unite(links_.position(c), links_.position(next_corner(c)));
    }
  std::vector<char> bends(kind_.size(), 0);
  for (std::uint32_t p = 0; p < kind_.size(); ++p)
    if (kind_[p] == bent) bends[lines.find(p)] = 1;
  for (std::uint32_t c : edges)
    if (links_.mate(c) != none && bends[lines.find(links_.position(c))]) links_.cut(c);
}

}  // namespace

void cut_joints(Links& links) { JointFinder(links).cut(); }

}  // namespace wrlkit::unwrap
