#include "passes/weld/faces.h"

#include <algorithm>
#include <bit>

#include "geometry/triangulation.h"
#include "passes/weld/value_table.h"

namespace wrlkit {
namespace {

constexpr std::uint32_t no_face = 0xffffffffu;
constexpr int most_starts = 8;  // of a face that comes through one point again and again; keeps the comparison linear

using Corners = std::span<const std::uint32_t>;

bool face_has_area(const Surface& s, Corners points) {
  auto at = [&](std::size_t i) { return s.points.data() + std::size_t{3} * points[i]; };
  for (std::size_t i = 2; i < points.size(); ++i)
    if (has_area(at(0), at(i - 1), at(i))) return true;
  return false;
}

/// A sum over the edges, which does not depend on where the face starts.
std::uint64_t hash(Corners face, bool both_ways) {
  std::uint64_t sum = 0;
  std::uint32_t last = face.back();
  for (std::uint32_t p : face) {
    std::uint64_t low = both_ways ? std::min(last, p) : last, high = both_ways ? std::max(last, p) : p;
    sum += mix((low << 32 | high) * 0x9e3779b97f4a7c15u);
    last = p;
  }
  return mix(sum);
}

/// Whether b runs like a, from the corner of b on that has the first point of a.
bool same_from(Corners a, Corners b, std::size_t start, bool backwards) {
  for (std::size_t i = 0, k = start, n = b.size(); i < n; ++i) {
    if (a[i] != b[k]) return false;
    k = backwards ? (k == 0 ? n : k) - 1 : (k + 1 == n ? 0 : k + 1);
  }
  return true;
}

bool same_face(Corners a, Corners b, bool both_ways) {
  if (a.size() != b.size()) return false;
  int starts = 0;
  for (std::size_t k = 0; k < b.size() && starts < most_starts; ++k) {
    if (b[k] != a[0]) continue;
    ++starts;
    if (same_from(a, b, k, false) || (both_ways && same_from(a, b, k, true))) return true;
  }
  return false;
}

}  // namespace

void FaceCleaner::drop_degenerate(const Surface& s) {
  const auto& points = s.mesh.corners;
  corners_.clear();
  face_begin_.assign(1, 0);
  std::size_t n_before = 0;  // corners of the faces that stay
  for (std::uint32_t f = 0; f < s.n_faces(); ++f) {
    std::size_t first = corners_.size();
    room_.clear();
    for (std::uint32_t c = s.begin(f); c < s.end(f); ++c) {
      if (!room_.empty() && room_.back() == points[c]) continue;
      if (c + 1 == s.end(f) && !room_.empty() && room_[0] == points[c]) continue;
      room_.push_back(points[c]);
      corners_.push_back(c);
    }
    if (face_has_area(s, room_)) {
      n_before += s.face(f).size();
      face_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
    } else {
      corners_.resize(first);
    }
  }
  counts.without_area = s.n_faces() - (face_begin_.size() - 1);
  if (corners_.empty()) return;
  counts.degenerate_faces += counts.without_area;
  counts.repeated_corners += n_before - corners_.size();
  if (corners_.size() < points.size()) keep(s, corners_, face_begin_);
}

void FaceCleaner::drop_duplicates(const Surface& s, bool both_ways) {
  heads_.assign(std::bit_ceil(std::size_t{s.n_faces()} + 8), no_face);
  next_.resize(s.n_faces());
  hashes_.resize(s.n_faces());
  corners_.clear();
  face_begin_.assign(1, 0);
  for (std::uint32_t f = 0; f < s.n_faces(); ++f) {
    auto face = s.face(f);
    std::uint64_t h = hash(face, both_ways);
    std::uint32_t& head = heads_[h & (heads_.size() - 1)];
    std::uint32_t other = head;
    while (other != no_face && !(hashes_[other] == h && same_face(s.face(other), face, both_ways)))
      other = next_[other];
    if (other != no_face) {
      ++counts.duplicate_faces;
      counts.duplicate_triangles += face.size() - 2;
      continue;
    }
    hashes_[f] = h;
    next_[f] = head;
    head = f;
    for (std::uint32_t c = s.begin(f); c < s.end(f); ++c) corners_.push_back(c);
    face_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
  }
  if (corners_.size() < s.mesh.corners.size()) keep(s, corners_, face_begin_);
}

void FaceCleaner::keep(const Surface& s, std::vector<std::uint32_t>& corners, std::vector<std::uint32_t>& face_begin) {
  take_corners(s.mesh, corners, room_);
  s.mesh.face_begin.swap(face_begin);
}

}  // namespace wrlkit
