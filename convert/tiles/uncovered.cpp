#include "convert/tiles/uncovered.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace wrlkit::tiles {
namespace {

constexpr double infinitely_far = std::numeric_limits<double>::infinity();
constexpr double told_apart = 0.05;      // of a distance: as much is added to the result (between_points in tiles.cpp)
constexpr double smallest_share = 0.25;  // of what is known: pieces that small are not cut
constexpr double promising = 0.5;        // of what is known: triangles with a point that far are looked at more closely
constexpr std::size_t most_cuts = 16;    // of a piece with a tile, in a round
constexpr std::size_t most_open = 2000;  // pieces that are followed

Vec3 middle_of(const std::array<Vec3, 3>& t) { return (1. / 3) * (t[0] + t[1] + t[2]); }

double radius_of(const std::array<Vec3, 3>& t) {
  const Vec3 middle = middle_of(t);
  double out = 0;
  for (const Vec3& p : t) out = std::max(out, fast_length(p - middle));
  return out;
}

/// How much farther a point of it is likely to be than its middle, at most.
double reach_of(const std::array<Vec3, 3>& t) {
  return std::min(radius_of(t), std::sqrt(fast_length(area_normal(t)) / 2));
}

/// One of points that are spread evenly (Roberts, 2018: R2, folded at the diagonal); the first is near the middle.
Vec3 spread_point(const std::array<Vec3, 3>& t, std::uint32_t k) {
  constexpr double first = 1. / 3, a = 0.7548776662466927, b = 0.5698402909980532;
  double whole = 0, u = std::modf(first + k * a, &whole), v = std::modf(first + k * b, &whole);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

double distance_of(const Box& box, const Box& from) {
  Vec3 way{};
  for (std::size_t k = 0; k < 3; ++k) way[k] = std::max({box.low[k] - from.high[k], from.low[k] - box.high[k], 0.0});
  return fast_length(way);
}

}  // namespace

Uncovered::Uncovered(const Soup& coarse, const Vec3& origin, double known, double least)
    : coarse_(coarse), origin_(origin), known_(known), least_(least) {
  const auto triangles = coarse.triangles();
  double area = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    if (is_usable(triangles[i])) area += fast_length(area_normal(triangles[i]));
  points_.reserve(2 * triangles.size() + coarse.positions.size() / 3);
  const double points_an_area = static_cast<double>(triangles.size()) / std::max(area, 1e-300);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto t = triangles[i];
    if (!is_usable(t)) continue;
    const auto n = 1 + static_cast<std::uint32_t>(points_an_area * fast_length(area_normal(t)));
    for (std::uint32_t k = 0; k < n; ++k) points_.push_back({spread_point(t, k), infinitely_far, i});
  }
  std::vector<char> is_taken(coarse.positions.size() / 3);
  for (const auto c : coarse.corners)
    if (!std::exchange(is_taken[c], 1)) points_.push_back({triangles.position(c), infinitely_far, no_triangle});
}

double Uncovered::enough() const { return known_ + told_apart * std::max(known_, least_); }

bool Uncovered::may_concern(const Open& open, const Box& box, bool first) const {
  Box around;
  for (const Vec3& p : open.corners) around.add(origin_ + p);
  if (first) return distance_of(box, around) <= known_;
  if (open.distance <= known_) return false;
  Box middle;
  middle.add(origin_ + middle_of(open.corners));
  return distance_of(box, middle) < open.distance;
}

bool Uncovered::may_concern(const Point& point, const Box& box, bool first) const {
  Box around;
  around.add(origin_ + point.at);
  return distance_of(box, around) <= (first ? known_ : point.distance) && (first || point.distance > known_);
}

bool Uncovered::concerns(const Box& box, bool first) const {
  const auto may = [&](const auto& o) { return may_concern(o, box, first); };
  return std::ranges::any_of(points_, may) || std::ranges::any_of(open_, may);
}

void Uncovered::ask(const Box& box, bool first, const Triangles& full, const ClosestPoint& nearest) {
  guess_ = ClosestPoint::no_guess;
  for (auto& point : points_)
    if (may_concern(point, box, first)) point.distance = std::min(point.distance, ask(point.at, full, nearest));
  std::erase_if(points_, [&](const Point& o) { return o.distance <= promising * known_; });
  left_.clear();
  for (const auto& open : open_)
    if (may_concern(open, box, first))
      settle(open, full, nearest, first);
    else
      left_.push_back(open);
  std::swap(open_, left_);
}

/// Of a point; 0 when it is too near to matter.
double Uncovered::ask(const Vec3& p, const Triangles& full, const ClosestPoint& nearest) {
  const double near = promising * known_;
  if (guess_ != ClosestPoint::no_guess && squared_distance(p, full[guess_]) <= near * near) return 0;
  const auto found = nearest.nearest(p, {}, guess_, near);
  if (found.triangle != ClosestPoint::no_guess) guess_ = found.triangle;
  return found.distance;
}

void Uncovered::settle(const Open& all, const Triangles& full, const ClosestPoint& nearest, bool may_cut) {
  pieces_.assign(1, all);
  // The largest first: when there are too many, those that are left are small.
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    Open open = pieces_[i];
    if (is_within(open.corners, full, enough())) continue;
    const double radius = radius_of(open.corners);
    const auto found = nearest.nearest(middle_of(open.corners), {}, guess_, std::max(enough() - radius, 0.));
    if (found.triangle != ClosestPoint::no_guess) guess_ = found.triangle;
    open.distance = std::min(open.distance, found.distance);
    if (open.distance + radius <= enough() || is_within(open.corners, full, enough())) continue;
    // What is not near to this tile may be near to another one. Pieces that are made in the second turn would not be
    // asked of the tiles before.
    if (!may_cut || found.distance > known_ || radius <= smallest_share * std::max(known_, least_) || i > most_cuts)
      left_.push_back(open);
    else
      cut(open, full[guess_]);
  }
}

bool Uncovered::is_within(const Corners& corners, const Triangles& full, double distance) const {
  if (guess_ == ClosestPoint::no_guess) return false;
  const auto to = full[guess_];
  return std::ranges::all_of(corners, [&](const Vec3& p) { return squared_distance(p, to) <= distance * distance; });
}

void Uncovered::cut(const Open& open, const Corners& full) {
  const auto& t = open.corners;
  std::array<double, 3> away{};
  for (std::size_t k = 0; k < 3; ++k) away[k] = std::sqrt(squared_distance(t[k], full));
  std::size_t best = 0;
  std::pair<double, double> most{-1, -1};
  for (std::size_t k = 0; k < 3; ++k) {
    const double length = fast_length(t[(k + 1) % 3] - t[k]), grows = away[(k + 1) % 3] - away[k];
    const std::pair steep(length > 0 ? grows * grows / length : 0., length);
    if (steep > most) {
      most = steep;
      best = k;
    }
  }
  const Vec3 a = t[best], b = t[(best + 1) % 3], c = t[(best + 2) % 3], between = 0.5 * (a + b);
  for (const Corners& half : {Corners{between, b, c}, Corners{a, between, c}})
    pieces_.push_back({half, reach_of(half), infinitely_far});
}

bool Uncovered::next_round() {
  for (const auto& point : points_) known_ = std::max(known_, point.distance);
  for (const auto& open : open_) known_ = std::max(known_, open.distance);
  if (!std::isfinite(known_)) return false;
  if (!std::exchange(is_between_points_, true)) look_between_points();
  std::erase_if(open_, [&](const Open& o) { return o.distance + o.reach <= enough(); });
  if (open_.size() > most_open) {
    const auto promise = [](const Open& o) { return o.distance + o.reach; };
    std::ranges::nth_element(open_, open_.begin() + most_open, std::greater{}, promise);
    open_.resize(most_open);
  }
  return !open_.empty();
}

/// Triangles that have a point that is far, and of the others the largest.
void Uncovered::look_between_points() {
  std::vector<double> far(coarse_.triangles().size(), -1);
  for (const auto& point : points_)
    if (point.triangle != no_triangle) far[point.triangle] = std::max(far[point.triangle], point.distance);
  points_ = {};
  std::vector<Open> others;
  for (std::uint32_t i = 0; i < coarse_.triangles().size(); ++i) {
    const auto t = coarse_.triangles()[i];
    const double reach = reach_of(t);
    if (far[i] >= 0)
      open_.push_back({t, reach, far[i]});
    else if (is_usable(t) && reach > enough())
      others.push_back({t, reach, infinitely_far});
  }
  std::ranges::stable_sort(others, std::greater{}, &Open::reach);
  if (open_.size() < most_open)
    open_.insert(open_.end(), others.begin(),
                 others.begin() + static_cast<std::ptrdiff_t>(std::min(others.size(), most_open - open_.size())));
}

}  // namespace wrlkit::tiles
