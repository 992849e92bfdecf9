#include "geometry/unwrap/grower.h"

#include <cmath>

namespace wrlkit::unwrap {
namespace {

constexpr double exact = 1e-4;           // a stretch of less is rounding
constexpr double most_stretched = 1.35;  // a triangle, when it is attached
constexpr double worst_stretched = 1.8;  // a triangle, after that
constexpr double joins_within = 0.3;     // of the triangle's size
constexpr float beyond_refused = 1.3f;   // squared distance: how much farther a distorted chart grows than where a
                                         // triangle was refused. Without that it grows fingers
constexpr int relaxing_steps = 30;
constexpr std::size_t few = 24;     // triangles among which no grid is needed
constexpr double most_cells = 512;  // that a triangle is wide

double extent_of(const Triangle2& t) {
  return std::max({std::abs(t[0].x - t[1].x), std::abs(t[1].x - t[2].x), std::abs(t[2].x - t[0].x),
                   std::abs(t[0].y - t[1].y), std::abs(t[1].y - t[2].y), std::abs(t[2].y - t[0].y)});
}

}  // namespace

Grower::Grower(const Links& links, const UnfoldOptions& options)
    : links_(links),
      options_(options),
      slot_(links.n_triangles(), none),
      of_chart_(links.n_triangles(), none),
      newest_(links.n_positions(), none),
      newest_chart_(links.n_positions(), none) {}

const Flattened& Grower::grow(std::uint32_t seed) {
  chart_.clear();
  previous_.clear();
  flat_.clear();
  refused_.clear();
  queue_ = {};
  n_kept_ = 0;
  reach_ = HUGE_VALF;
  area_ = 0;
  extent_ = 0;
  distorted_ = searching_ = false;
  next_spread_ = 32;
  Triangle2 t = links_.shape(seed);
  center_ = (1. / 3) * (t[0] + t[1] + t[2]);
  std::array<std::uint32_t, 3> points;
  for (std::uint32_t k = 0; k < 3; ++k) {
    points[k] = k;
    chart_.points.push_back(t[k]);
    previous_.push_back(none);
    std::uint32_t p = links_.position(3 * seed + k);
    newest_[p] = k;
    newest_chart_[p] = n_charts_;
  }
  place(seed, points);
  advance();
  ++n_charts_;
  return chart_;
}

void Grower::advance() {
  constexpr int rounds = 6;
  for (int round = 0; round < rounds; ++round) {
    std::size_t before = chart_.triangles.size();
    if (!empty_queue()) return;
    if (!distorted_ || !spread()) return;
    if (round > 0 && chart_.triangles.size() < before + before / 50) return;
    offer_again();
  }
}

/// False: the chart is finished.
bool Grower::empty_queue() {
  while (!flat_.empty() || !queue_.empty()) {
    Candidate c = flat_.empty() ? queue_.top() : Candidate{-1, flat_.back()};
    flat_.empty() ? queue_.pop() : flat_.pop_back();
    if (taken(links_.mate(c.corner) / 3)) continue;
    if (c.distance > reach_ || !attach(c.corner)) {
      refused_.push_back(c.corner);
      if (distorted_ && c.distance > 0) reach_ = std::min(reach_, beyond_refused * c.distance);
    }
    if (chart_.triangles.size() < next_spread_ || !flat_.empty()) continue;
    next_spread_ = chart_.triangles.size() * 3 / 2;
    if (!distorted_)
      index();
    else if (spread())
      offer_again();
    else
      return false;
  }
  return true;
}

void Grower::offer_again() {
  reach_ = HUGE_VALF;
  std::vector<std::uint32_t> corners;
  corners.swap(refused_);
  for (std::uint32_t c : corners) offer(c);
}

/// Whether the neighbour fills a notch: another of its edges is the chart's, and hangs together with this one.
bool Grower::closes(std::uint32_t corner) const {
  std::uint32_t mate = links_.mate(corner);
  auto in_chart = [&](std::uint32_t c) { return c != none && of_chart_[c / 3] == n_charts_; };
  std::uint32_t after = links_.mate(next_corner(mate)), before = links_.mate(previous_corner(mate));
  return (in_chart(after) && point_at(next_corner(after)) == point_at(corner)) ||
         (in_chart(before) && point_at(before) == point_at(next_corner(corner)));
}

void Grower::offer(std::uint32_t corner) {
  std::uint32_t mate = links_.mate(corner);
  if (mate == none || taken(mate / 3)) return;
  if (links_.flat(corner)) return flat_.push_back(corner);
  if (closes(corner)) return queue_.push({-1, corner});
  Point2 middle = 0.5 * (chart_.points[point_at(corner)] + chart_.points[point_at(next_corner(corner))]) - center_;
  queue_.push({static_cast<float>(dot(middle, middle)), corner});
}

/// Where the corner beyond the edge from `corner` comes when the neighbour is laid down.
Point2 Grower::unfold_corner(std::uint32_t corner, std::uint32_t opposite) const {
  Point2 a = chart_.points[point_at(corner)], b = chart_.points[point_at(next_corner(corner))];
  Triangle2 s = links_.shape(opposite / 3);
  Point2 p = s[next_corner(opposite) % 3], q = s[previous_corner(opposite) % 3], o = s[opposite % 3];
  Point2 edge = q - p;
  double l2 = dot(edge, edge), length = std::sqrt(l2), laid = std::sqrt(dot(a - b, a - b));
  if (!(laid > 0 && l2 > 0)) return a;
  double along = dot(o - p, edge) / l2 - 0.5, height = cross(edge, o - p) / length;
  Point2 u = (1 / laid) * (a - b);
  return 0.5 * (a + b) + along * length * u + height * Point2{-u.y, u.x};
}

/// The nearest of the places of that position in this chart.
std::uint32_t Grower::known_point(std::uint32_t position, Point2 near, double within) const {
  if (newest_chart_[position] != n_charts_) return none;
  double best = within * within;
  std::uint32_t found = none;
  for (std::uint32_t p = newest_[position]; p != none; p = previous_[p]) {
    Point2 d = chart_.points[p] - near;
    if (dot(d, d) < best) {
      best = dot(d, d);
      found = p;
    }
  }
  return found;
}

bool Grower::attach(std::uint32_t corner) {
  std::uint32_t mate = links_.mate(corner), triangle = mate / 3, opposite = previous_corner(mate);
  Point2 where = unfold_corner(corner, opposite);
  Point2 a = chart_.points[point_at(corner)], b = chart_.points[point_at(next_corner(corner))];
  double size = std::sqrt(std::min(dot(where - a, where - a), dot(where - b, where - b)));
  std::uint32_t position = links_.position(opposite), point = known_point(position, where, joins_within * size);
  if (point != none) where = chart_.points[point];
  Triangle2 t;
  t[mate % 3] = b;
  t[next_corner(mate) % 3] = a;
  t[opposite % 3] = where;
  if (!fits(triangle, t)) return false;
  if (point == none) {
    point = static_cast<std::uint32_t>(chart_.points.size());
    chart_.points.push_back(where);
    previous_.push_back(newest_chart_[position] == n_charts_ ? newest_[position] : none);
    newest_[position] = point;
    newest_chart_[position] = n_charts_;
  }
  std::array<std::uint32_t, 3> points;
  points[mate % 3] = point_at(next_corner(corner));
  points[next_corner(mate) % 3] = point_at(corner);
  points[opposite % 3] = point;
  place(triangle, points);
  return true;
}

bool Grower::fits(std::uint32_t triangle, const Triangle2& t) {
  if (!(links_.area(triangle) > 0)) return true;
  Stretch s = stretch_of(links_.shape(triangle), t);
  if (!(s.most < most_stretched && s.least > 1 / most_stretched)) return false;
  if (!clear_of_others(t)) return false;
  if (!distorted_ && (s.most > 1 + exact || s.least < 1 - exact)) {
    distorted_ = true;
    keep();
  }
  return true;
}

bool Grower::at_rim(std::uint32_t slot) const {
  std::uint32_t t = chart_.triangles[slot];
  for (std::uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
    std::uint32_t m = links_.mate(c);
    if (m == none || of_chart_[m / 3] != n_charts_) return true;
    if (point_at(c) != point_at(next_corner(m)) || point_at(next_corner(c)) != point_at(m)) return true;
  }
  return false;
}

bool Grower::clear_of_others(const Triangle2& t) {
  if (!searching_) {
    for (std::size_t i = 0; i < chart_.triangles.size(); ++i)
      if (overlap(t, chart_.at(i))) return false;
    return true;
  }
  keep_cells_large(extent_of(t));
  return !grid_.overlaps(t, [&](std::uint32_t slot, Triangle2& other) {
    if (!at_rim(slot)) return false;
    other = chart_.at(slot);
    return true;
  });
}

void Grower::place(std::uint32_t triangle, const std::array<std::uint32_t, 3>& points) {
  auto slot = static_cast<std::uint32_t>(chart_.triangles.size());
  slot_[triangle] = slot;
  of_chart_[triangle] = n_charts_;
  chart_.triangles.push_back(triangle);
  chart_.corner_point.insert(chart_.corner_point.end(), points.begin(), points.end());
  area_ += links_.area(triangle) / 2;
  keep_cells_large(extent_of(chart_.at(slot)));
  for (std::uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) offer(c);
  if (searching_)
    grid_.insert(chart_.at(slot), slot);
  else if (chart_.triangles.size() > few)
    index();
}

/// So that no needle lies in very many.
void Grower::keep_cells_large(double extent) {
  extent_ = std::max(extent_, extent);
  if (searching_ && extent_ > 2 * most_cells * cell_) index();
}

void Grower::index() {
  if (!(chart_.triangles.size() > few)) return;
  searching_ = true;
  double n = static_cast<double>(chart_.triangles.size());
  cell_ = std::max(1.5 * std::sqrt(area_ / n), extent_ / most_cells);
  grid_.reset(cell_, 2 * chart_.triangles.size());
  for (std::uint32_t i = 0; i < chart_.triangles.size(); ++i)
    if (at_rim(i)) grid_.insert(chart_.at(i), i);
}

void Grower::keep() {
  kept_ = chart_.points;
  n_kept_ = chart_.triangles.size();
}

/// Lets go what came after.
void Grower::take_back() {
  for (std::size_t i = n_kept_; i < chart_.triangles.size(); ++i)
    slot_[chart_.triangles[i]] = of_chart_[chart_.triangles[i]] = none;
  chart_.triangles.resize(n_kept_);
  chart_.corner_point.resize(3 * n_kept_);
  chart_.points = kept_;
}

/// False: that was too much, and the chart is again as it was after the last time.
bool Grower::spread() {
  relaxer_.run(links_, chart_, relaxing_steps);
  if (sound() && !too_stretched()) {
    keep();
    return true;
  }
  take_back();
  return false;
}

bool Grower::too_stretched() const {
  double sum = 0, area = 0;
  for (std::size_t i = 0; i < chart_.triangles.size(); ++i) {
    double a = links_.area(chart_.triangles[i]);
    if (!(a > 0)) continue;
    Stretch s = stretch_of(links_.shape(chart_.triangles[i]), chart_.at(i));
    sum += a * (1 / (s.least * s.least) + 1 / (s.most * s.most)) / 2;
    area += a;
  }
  return sum > area * options_.max_stretch * options_.max_stretch;
}

/// Whether no triangle is mirrored or lies on another.
bool Grower::sound() {
  for (std::size_t i = 0; i < chart_.triangles.size(); ++i)
    if (links_.area(chart_.triangles[i]) > 0)
      if (!(stretch_of(links_.shape(chart_.triangles[i]), chart_.at(i)).least > 1 / worst_stretched)) return false;
  if (chart_.triangles.size() <= few) {
    for (std::size_t i = 0; i < chart_.triangles.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (overlap(chart_.at(i), chart_.at(k))) return false;
    return true;
  }
  index();
  for (std::uint32_t i = 0; i < chart_.triangles.size(); ++i)
    if (at_rim(i) && grid_.overlaps(chart_.at(i), [&](std::uint32_t slot, Triangle2& other) {
          other = chart_.at(slot);
          if (slot == i) other = {Point2{HUGE_VAL, HUGE_VAL}, {HUGE_VAL, HUGE_VAL}, {HUGE_VAL, HUGE_VAL}};
          return true;
        }))
      return false;
  return true;
}

}  // namespace wrlkit::unwrap
