#include "geometry/outline.h"

#include <algorithm>
#include <cmath>

namespace wrlkit {
namespace {

constexpr double most_chords = 64;  // of one curve
constexpr std::size_t probes = 16;  // points of a ring that tell whether it is inside another one

/// How far a curve bends away from the straight line at its control point.
double bend(const Vec2& a, const Vec2& b, const Vec2& c) {
  return std::hypot(a[0] - 2 * b[0] + c[0], a[1] - 2 * b[1] + c[1]);
}

Vec2 mix(const Vec2& a, const Vec2& b, double t) { return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}; }

bool inside(const std::vector<Vec2>& ring, const Vec2& p) {
  bool in = false;
  for (std::size_t i = 0, last = ring.size() - 1; i < ring.size(); last = i++) {
    const Vec2 &a = ring[last], &b = ring[i];
    if ((a[1] > p[1]) == (b[1] > p[1])) continue;
    in ^= (orientation(a, b, p) > 0) == (b[1] > a[1]);
  }
  return in;
}

}  // namespace

void Outline::move_to(const Vec2& p) {
  rings_.emplace_back();
  line_to(p);
}

void Outline::line_to(const Vec2& p) {
  if (rings_.empty()) rings_.emplace_back();
  auto& points = rings_.back().points;
  if (points.empty() || points.back() != p) points.push_back(p);
}

/// A curve cut into n chords is n * n times closer to them than to one.
std::size_t Outline::chords(double distance) const {
  double n = std::ceil(std::sqrt(distance / tolerance_));
  return static_cast<std::size_t>(std::clamp(n, 1.0, most_chords));
}

void Outline::conic_to(const Vec2& control, const Vec2& p) {
  if (rings_.empty() || rings_.back().points.empty()) return line_to(p);
  const Vec2 from = rings_.back().points.back();
  for (std::size_t i = 1, n = chords(bend(from, control, p) / 4); i <= n; ++i) {
    double t = static_cast<double>(i) / static_cast<double>(n);
    line_to(i == n ? p : mix(mix(from, control, t), mix(control, p, t), t));
  }
}

void Outline::cubic_to(const Vec2& control, const Vec2& control2, const Vec2& p) {
  if (rings_.empty() || rings_.back().points.empty()) return line_to(p);
  const Vec2 from = rings_.back().points.back();
  double most = std::max(bend(from, control, control2), bend(control, control2, p));
  for (std::size_t i = 1, n = chords(0.75 * most); i <= n; ++i) {
    double t = static_cast<double>(i) / static_cast<double>(n);
    Vec2 middle = mix(control, control2, t), left = mix(mix(from, control, t), middle, t),
         right = mix(middle, mix(control2, p, t), t);
    line_to(i == n ? p : mix(left, right, t));
  }
}

void Outline::measure(Ring& ring) const {
  auto& p = ring.points;
  while (p.size() > 1 && p.front() == p.back()) p.pop_back();
  if (p.empty()) return;
  for (const Vec2& point : p) ring.box.add(point);
  for (std::size_t i = 1; i + 1 < p.size(); ++i) ring.area += orientation(p[0], p[i], p[i + 1]);
}

/// Whether all of the inner ring is inside the outer one, as far as some of its points tell.
bool Outline::contains(const Ring& outer, const Ring& inner) {
  for (int k = 0; k < 2; ++k)
    if (inner.box.low[k] < outer.box.low[k] || inner.box.high[k] > outer.box.high[k]) return false;
  std::size_t step = 1 + (inner.points.size() - 1) / probes, out = 0;
  for (std::size_t i = 0; i < inner.points.size(); i += step)
    if (!inside(outer.points, inner.points[i]) && ++out > 1) return false;  // one may touch the boundary
  return true;
}

void Outline::cut(std::vector<Vec2>& points, std::vector<std::uint32_t>& triangles) {
  for (auto& ring : rings_) measure(ring);
  std::erase_if(rings_, [](const Ring& r) { return r.points.size() < 3 || r.area == 0; });
  std::ranges::stable_sort(rings_, std::greater{}, [](const Ring& r) { return std::abs(r.area); });
  for (std::size_t i = 0; i < rings_.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (contains(rings_[k], rings_[i])) {
        rings_[i].winding += rings_[k].area > 0 ? 1 : -1;
        if (rings_[k].is_outer()) rings_[i].inside_of = &rings_[k];
      }
  PolygonCutter cutter;
  std::vector<Vec2> part;
  std::vector<std::uint32_t> ends;
  for (auto& outer : rings_) {
    if (!outer.is_outer()) continue;
    part.clear();
    ends.clear();
    for (auto& ring : rings_)
      if (&ring == &outer || (ring.is_hole() && ring.inside_of == &outer)) {
        part.insert(part.end(), ring.points.begin(), ring.points.end());
        ends.push_back(static_cast<std::uint32_t>(part.size()));
      }
    cutter.cut(part, ends);
    auto first = static_cast<std::uint32_t>(points.size());
    points.insert(points.end(), part.begin(), part.end());
    for (auto c : cutter.corners()) triangles.push_back(first + c);
  }
}

}  // namespace wrlkit
