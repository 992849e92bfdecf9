#include "light/patches/patch_mesh.h"

#include <algorithm>
#include <bit>
#include <unordered_map>
#include <utility>

#include "base/hashing.h"

namespace wrlkit::light {
namespace {

constexpr int next(int i) { return i == 2 ? 0 : i + 1; }

struct PointHash {
  std::size_t operator()(const std::array<std::uint64_t, 3>& p) const {
    std::uint64_t h = 0;
    for (auto v : p) h = mixed(h, v);
    return h;
  }
};

std::array<std::uint64_t, 3> bits(const V3& p) {
  return {std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
          std::bit_cast<std::uint64_t>(p.z + 0.0)};
}

}  // namespace

PatchMesh::PatchMesh(std::span<const std::array<V3, 3>> triangles) {
  std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, PointHash> numbers;
  faces_.reserve(triangles.size());
  for (const auto& t : triangles) {
    Face f{{}, {none, none, none}, static_cast<std::uint32_t>(faces_.size())};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [at, added] = numbers.try_emplace(bits(t[i]), static_cast<std::uint32_t>(points_.size()));
      if (added) points_.push_back(t[i]);
      f.corners[i] = at->second;
    }
    first_child_.push_back(f.triangle);
    triangles_.push_back(f.corners);
    faces_.push_back(f);
  }
  child_at_.assign(faces_.size(), none);
  link();
}

void PatchMesh::link() {
  struct Side {
    std::uint64_t key;  // both corners, the lower one first
    std::uint32_t face;
    int side;
  };
  std::vector<Side> sides;
  sides.reserve(faces_.size() * 3);
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (int i = 0; i < 3 && !is_collapsed(f); ++i) {
      const auto [low, high] = std::minmax(faces_[f].corners[i], faces_[f].corners[next(i)]);
      sides.push_back({std::uint64_t{low} << 32 | high, f, i});
    }
  std::ranges::stable_sort(sides, {}, &Side::key);
  for (std::size_t i = 0, end; i < sides.size(); i = end) {
    for (end = i + 1; end < sides.size() && sides[end].key == sides[i].key;) ++end;
    const auto &a = sides[i], &b = sides[i + 1 < sides.size() ? i + 1 : i];
    if (end - i != 2 || a.face == b.face) continue;
    faces_[a.face].neighbours[a.side] = b.face;
    faces_[b.face].neighbours[b.side] = a.face;
  }
}

bool PatchMesh::is_collapsed(std::size_t face) const {
  const auto& c = faces_[face].corners;
  return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
}

double PatchMesh::longest(std::size_t face) const {
  const auto f = static_cast<std::uint32_t>(face);
  return is_collapsed(face) ? 0 : std::sqrt(edge(f, longest_edge(f)).square);
}

std::array<V3, 3> PatchMesh::triangle(std::uint32_t t) const {
  const auto& c = triangles_[t];
  return {points_[c[0]], points_[c[1]], points_[c[2]]};
}

double PatchMesh::triangle_area(std::uint32_t t) const { return 0.5 * length(across(triangle(t))); }

std::array<V3, 3> PatchMesh::corners(std::size_t face) const {
  const auto& c = faces_[face].corners;
  return {points_[c[0]], points_[c[1]], points_[c[2]]};
}

double PatchMesh::area(std::size_t face) const { return 0.5 * length(across(corners(face))); }

bool PatchMesh::flat(std::size_t a, std::size_t b) const {
  constexpr double least_cosine = 0.99;
  return dot(unit(across(corners(a))), unit(across(corners(b)))) > least_cosine;
}

PatchMesh::Edge PatchMesh::edge(std::uint32_t face, int i) const {
  const auto [low, high] = std::minmax(faces_[face].corners[i], faces_[face].corners[next(i)]);
  const V3 d = points_[high] - points_[low];
  return {dot(d, d), low, high};
}

int PatchMesh::longest_edge(std::uint32_t face) const {
  int best = 0;
  for (int i : {1, 2})
    if (edge(face, i) > edge(face, best)) best = i;
  return best;
}

int PatchMesh::side_of(std::uint32_t face, const Edge& e) const {
  int i = 0;
  while (i < 2 && edge(face, i) != e) ++i;
  return i;
}

// Each face on the path has a longer edge than the one before, so it ends: at a border, or at an edge that is the
// longest of both its faces.
void PatchMesh::split(std::size_t face) {
  path_.assign(1, static_cast<std::uint32_t>(face));
  while (!path_.empty()) {
    const auto f = path_.back();
    const int side = longest_edge(f);
    const auto n = faces_[f].neighbours[side];
    if (n != none && edge(n, longest_edge(n)) != edge(f, side)) {
      path_.push_back(n);
      continue;
    }
    bisect(f, side);
    path_.pop_back();
  }
}

void PatchMesh::bisect(std::uint32_t face, int side) {
  const Edge e = edge(face, side);
  const auto other = faces_[face].neighbours[side];
  const int other_side = other == none ? 0 : side_of(other, e);
  const auto middle = static_cast<std::uint32_t>(points_.size());
  points_.push_back(0.5 * points_[e.low] + 0.5 * points_[e.high]);
  // The first half of each keeps the edge's beginning, so which halves face one another depends on both directions.
  const bool opposed = other != none && faces_[face].corners[side] != faces_[other].corners[other_side];
  const auto second = halve(face, side, middle);
  if (other == none) return;
  const auto other_second = halve(other, other_side, middle);
  const auto at_begin = opposed ? other_second : other, at_end = opposed ? other : other_second;
  faces_[face].neighbours[side] = at_begin;
  faces_[second].neighbours[side] = at_end;
  faces_[at_begin].neighbours[other_side] = face;
  faces_[at_end].neighbours[other_side] = second;
}

/// (a, b, c) with the edge a-b becomes (a, m, c); the new face is (m, b, c). Halves of the edge have its number in
/// both.
std::uint32_t PatchMesh::halve(std::uint32_t face, int side, std::uint32_t middle) {
  const auto second = static_cast<std::uint32_t>(faces_.size());
  faces_.push_back(faces_[face]);
  Face &first = faces_[face], &last = faces_.back();
  const int to_c = next(side), to_a = next(to_c);
  record_cut(face, second, {first.corners[side], middle, first.corners[to_a], {face, second}});
  first.corners[to_c] = middle;
  last.corners[side] = middle;
  first.neighbours[side] = last.neighbours[side] = none;
  first.neighbours[to_c] = second;  // m-c
  last.neighbours[to_a] = face;     // c-m
  if (const auto n = last.neighbours[to_c]; n != none) faces_[n].neighbours[side_of(n, edge(second, to_c))] = second;
  return second;
}

void PatchMesh::record_cut(std::uint32_t face, std::uint32_t second, const Cut& made) {
  const auto number = static_cast<std::uint32_t>(cuts_.size());
  const auto at = child_at_[face];
  (at == none ? first_child_[faces_[face].triangle] : cuts_[at / 2].children[at % 2]) = cut | number;
  cuts_.push_back(made);
  child_at_[face] = 2 * number;
  child_at_.resize(second + 1);
  child_at_[second] = 2 * number + 1;
}

std::uint32_t PatchMesh::locate(std::uint32_t triangle, const V3& point) const {
  auto at = first_child_[triangle];
  while (at & cut) {
    const Cut& c = cuts_[at & ~cut];
    // The line from the middle to the apex, and which side of it the beginning is on.
    const V3 m = points_[c.middle], along = points_[c.apex] - m, to_begin = points_[c.begin] - m;
    const V3 across = dot(along, along) * to_begin - dot(to_begin, along) * along;
    at = c.children[dot(across, point - m) < 0];
  }
  return at;
}

bool PatchMesh::split_to(double max_edge, double max_area, std::size_t limit) {
  for (std::size_t f = 0; f < faces_.size(); ++f)
    while ((max_edge > 0 && longest(f) > max_edge) || (max_area > 0 && area(f) > max_area)) {
      if (faces_.size() >= limit) return false;
      split(f);
    }
  return true;
}

}  // namespace wrlkit::light
