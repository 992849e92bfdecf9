// An edge lies in a grid of cells that are at least as long as itself, so that it meets eight of them at most; there is
// such a grid for each power of two, and a point looks into one cell of each. A plane of a hundred metres and the bolts
// on it do not get into each other's way like this. Only open edges can have a point on them, and only the points of
// open edges can be on one, so that a closed surface costs nothing.
#include "passes/weld/t_junctions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wrlkit {
namespace {

constexpr double most_levels = 24;         // shorter edges are treated like those of the lowest level
constexpr std::size_t tests_a_point = 64;  // on average; real surfaces need one or two
constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();   // by the largest coordinate
constexpr double junction_slack = std::numeric_limits<float>::epsilon();  // the same
constexpr float shortest_normal = 1e-12f;                                 // squared

double size_of_cells(double level) { return std::ldexp(1, static_cast<int>(level)); }

}  // namespace

std::size_t TJunctions::close(const Surface& s, const std::vector<SurfaceEdge>& edges, double tolerance) {
  collect(s, edges);
  if (edges_.size() < 3) return 0;
  double largest = 0;
  for (double v : s.points) largest = std::max(largest, std::abs(v));
  near_ = std::max(tolerance, rounding * largest);
  end_ = std::max(tolerance, junction_slack * largest);
  spread_edges(s);
  junctions_.clear();
  budget_ = tests_a_point * points_.size();
  for (std::uint32_t p : points_) find_edges(s, p);
  std::ranges::sort(junctions_, [](const Junction& a, const Junction& b) {
    return a.corner != b.corner ? a.corner < b.corner : a.at != b.at ? a.at < b.at : a.point < b.point;
  });
  auto same = [](const Junction& a, const Junction& b) { return a.corner == b.corner && a.point == b.point; };
  junctions_.erase(std::unique(junctions_.begin(), junctions_.end(), same), junctions_.end());
  if (!junctions_.empty()) insert(s);
  return junctions_.size();
}

void TJunctions::collect(const Surface& s, const std::vector<SurfaceEdge>& edges) {
  edges_.clear();
  points_.clear();
  for (const SurfaceEdge& e : edges)
    if (e.open()) edges_.push_back({e.first, 0});
  if (edges_.empty()) return;
  listed_.assign(s.n_points(), 0);
  for (const OpenEdge& e : edges_)
    for (std::uint32_t c : {e.corner, s.after(e.corner)}) {
      std::uint32_t p = s.mesh.corners[c];
      if (!listed_[p]) points_.push_back(p);
      listed_[p] = 1;
    }
}

void TJunctions::spread_edges(const Surface& s) {
  double highest = -2000;
  for (OpenEdge& e : edges_) {
    double l = length(s.point(s.mesh.corners[e.corner]) - s.point(s.mesh.corners[s.after(e.corner)]));
    e.level = std::clamp(std::ceil(std::log2(l + 2 * near_)), -1000., 1000.);
    highest = std::max(highest, e.level);
  }
  levels_.clear();
  grid_.start(edges_.size());
  for (OpenEdge& e : edges_) {
    e.level = std::max(e.level, highest - most_levels);
    if (std::ranges::find(levels_, e.level) == levels_.end()) levels_.push_back(e.level);
    Vec3 a = s.point(s.mesh.corners[e.corner]), b = s.point(s.mesh.corners[s.after(e.corner)]), low, high;
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(a[i], b[i]) - near_;
      high[i] = std::max(a[i], b[i]) + near_;
    }
    for_each_cell(low, high, size_of_cells(e.level), [&](const Vec3& cell) { grid_.add(cell, e.corner, e.level); });
  }
}

void TJunctions::find_edges(const Surface& s, std::uint32_t point) {
  const Vec3 p = s.point(point);
  for (double level : levels_) {
    if (budget_ == 0) return;
    for_each_cell(p, p, size_of_cells(level), [&](const Vec3& cell) {
      grid_.visit(
          cell, [&](std::uint32_t corner) { test(s, corner, point); }, level);
    });
  }
}

void TJunctions::test(const Surface& s, std::uint32_t corner, std::uint32_t point) {
  if (budget_ == 0) return;
  --budget_;
  std::uint32_t from = s.mesh.corners[corner], to = s.mesh.corners[s.after(corner)];
  if (point == from || point == to) return;
  Vec3 a = s.point(from), along = s.point(to) - a, d = s.point(point) - a;
  double square = dot(along, along), at = dot(d, along) / square, margin = end_ / std::sqrt(square);
  Vec3 off = d - at * along;
  if (!(at > margin && at < 1 - margin) || dot(off, off) > near_ * near_) return;
  auto face = s.face(s.face_of[corner]);
  budget_ -= std::min(budget_, face.size());
  if (std::ranges::find(face, point) == face.end()) junctions_.push_back({corner, point, at});
}

/// Attributes first, while the corners still tell where they are.
void TJunctions::insert(const Surface& s) {
  Mesh& mesh = s.mesh;
  for (Attribute* a : mesh.attributes())
    if (a->present()) interpolate(*a, s);
  face_begin_.assign(1, 0);
  room_.clear();
  auto next = junctions_.begin();
  for (std::uint32_t f = 0; f < s.n_faces(); ++f) {
    for (std::uint32_t c = s.begin(f); c < s.end(f); ++c) {
      room_.push_back(mesh.corners[c]);
      for (; next != junctions_.end() && next->corner == c; ++next) room_.push_back(next->point);
    }
    face_begin_.push_back(static_cast<std::uint32_t>(room_.size()));
  }
  mesh.corners.swap(room_);
  mesh.face_begin.swap(face_begin_);
}

void TJunctions::interpolate(Attribute& a, const Surface& s) {
  auto mixed = [&](std::uint32_t from, std::uint32_t to, double at) {
    if (from == to) return from;
    auto n = static_cast<std::uint32_t>(a.count());
    float square = 0;
    for (int i = 0; i < a.width; ++i) {
      a.values.push_back(static_cast<float>(a.at(from)[i] + at * (a.at(to)[i] - a.at(from)[i])));
      square += a.values.back() * a.values.back();
    }
    if (&a == &s.mesh.normal && square > shortest_normal)
      for (int i = 0; i < 3; ++i) a.values[a.values.size() - 1 - i] /= std::sqrt(square);
    return n;
  };
  room_.clear();
  auto next = junctions_.begin();
  for (std::uint32_t c = 0; c < a.index.size(); ++c) {
    room_.push_back(a.index[c]);
    for (; next != junctions_.end() && next->corner == c; ++next)
      room_.push_back(mixed(a.index[c], a.index[s.after(c)], next->at));
  }
  a.index.swap(room_);
}

}  // namespace wrlkit
