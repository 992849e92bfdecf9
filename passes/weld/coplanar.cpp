// A region grows face by face and stays a disk: a face is added only if what it shares with the region is one run of
// edges, and no other point. So the outline of a region is one simple polygon at any time, and a face that would close
// a ring around a hole stays outside.
#include "passes/weld/coplanar.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace wrlkit {
namespace {

constexpr double indistinct = std::numeric_limits<float>::epsilon();  // by the largest coordinate
constexpr double same_value = 1e-5;                                   // of normals, colours, texture coordinates
constexpr double reflex = 1e-6;                                       // sine of a turn that makes a polygon concave

}  // namespace

std::size_t CoplanarMerger::merge(const Surface& s, const std::vector<SurfaceEdge>& edges, double tolerance,
                                  StampedMap& map) {
  double largest = 0;
  for (double v : s.points) largest = std::max(largest, std::abs(v));
  near_ = std::max(tolerance, indistinct * largest);
  prepare(s, edges, map);
  corners_.clear();
  face_begin_.assign(1, 0);
  concave_ = false;
  for (std::uint32_t f = 0; f < s.n_faces(); ++f)
    if (region_[f] == none) grow(s, f);
  std::size_t n = s.n_faces() - (face_begin_.size() - 1);
  if (n == 0) return 0;
  take_corners(s.mesh, corners_, room_);
  s.mesh.face_begin.swap(face_begin_);
  if (concave_) s.mesh.convex = false;
  return n;
}

void CoplanarMerger::prepare(const Surface& s, const std::vector<SurfaceEdge>& edges, StampedMap& map) {
  const auto& corners = s.mesh.corners;
  mate_.assign(corners.size(), none);
  for (const SurfaceEdge& e : edges) {
    bool opposite = e.manifold() && corners[e.first] != corners[e.second];
    if (!opposite || s.face_of[e.first] == s.face_of[e.second]) continue;
    mate_[e.first] = e.second;
    mate_[e.second] = e.first;
  }
  simple_.assign(s.n_faces(), 1);
  for (std::uint32_t f = 0; f < s.n_faces(); ++f) {
    map.reset(s.n_points());
    for (std::uint32_t p : s.face(f)) {
      if (map.contains(p)) simple_[f] = 0;
      map.set(p, 0);
    }
  }
  region_.assign(s.n_faces(), none);
  point_in_.assign(s.n_points(), none);
}

/// Its plane, and the largest of the triangles at its first corner.
CoplanarMerger::Frame CoplanarMerger::frame_of(const Surface& s, std::uint32_t f) const {
  Frame frame{};
  const Vec3 area = s.area_vector(f);
  auto face = s.face(f);
  double best = 0;
  frame.origin = s.point(face[0]);
  frame.normal = unit(area);
  for (std::uint32_t i = 2; i < face.size(); ++i) {
    Vec3 u = s.point(face[i - 1]) - frame.origin, v = s.point(face[i]) - frame.origin;
    double a = dot(cross(u, v), frame.normal);
    if (!(a > best)) continue;
    best = a;
    frame.u = u;
    frame.v = v;
    frame.corners[0] = s.begin(f);
    frame.corners[1] = s.begin(f) + i - 1;
    frame.corners[2] = s.begin(f) + i;
  }
  frame.uu = dot(frame.u, frame.u);
  frame.uv = dot(frame.u, frame.v);
  frame.vv = dot(frame.v, frame.v);
  frame.good = best > 0;
  return frame;
}

void CoplanarMerger::grow(const Surface& s, std::uint32_t seed) {
  members_.clear();
  queue_.clear();
  add(s, seed, seed);
  const Frame frame = frame_of(s, seed);
  if (frame.good && simple_[seed] && fits(s, frame, seed))
    for (std::size_t i = 0; i < queue_.size(); ++i) {  // NOLINT(modernize-loop-convert): it grows
      std::uint32_t f = s.face_of[queue_[i]];
      if (region_[f] == none && simple_[f] && keeps_disk(s, seed, f) && fits(s, frame, f)) add(s, seed, f);
    }
  if (members_.size() > 1 && outline(s, seed)) return note_concave(s, frame.normal);
  std::ranges::sort(members_);
  for (std::uint32_t f : members_) {
    for (std::uint32_t c = s.begin(f); c < s.end(f); ++c) corners_.push_back(c);
    face_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
  }
}

/// Its neighbours are to be looked at, once more those that did not fit the smaller region.
void CoplanarMerger::add(const Surface& s, std::uint32_t seed, std::uint32_t f) {
  region_[f] = seed;
  members_.push_back(f);
  for (std::uint32_t p : s.face(f)) point_in_[p] = seed;
  for (std::uint32_t c = s.begin(f); c < s.end(f); ++c)
    if (mate_[c] != none && region_[s.face_of[mate_[c]]] == none) queue_.push_back(mate_[c]);
}

bool CoplanarMerger::fits(const Surface& s, const Frame& frame, std::uint32_t f) const {
  if (!(dot(s.area_vector(f), frame.normal) > 0)) return false;
  const double det = frame.uu * frame.vv - frame.uv * frame.uv;
  for (std::uint32_t c = s.begin(f); c < s.end(f); ++c) {
    Vec3 d = s.point(s.mesh.corners[c]) - frame.origin;
    if (!(std::abs(dot(d, frame.normal)) <= near_)) return false;
    double du = dot(d, frame.u), dv = dot(d, frame.v);
    double x = (du * frame.vv - dv * frame.uv) / det, y = (dv * frame.uu - du * frame.uv) / det;
    for (const Attribute* a : std::as_const(s.mesh).attributes())
      if (a->present() && !linear(*a, frame, x, y, c)) return false;
  }
  return true;
}

bool CoplanarMerger::linear(const Attribute& a, const Frame& frame, double x, double y, std::uint32_t corner) const {
  const float *v0 = a.at(a.index[frame.corners[0]]), *v1 = a.at(a.index[frame.corners[1]]),
              *v2 = a.at(a.index[frame.corners[2]]);
  const float* v = a.at(a.index[corner]);
  for (int i = 0; i < a.width; ++i) {
    double want = v0[i] + x * (double{v1[i]} - v0[i]) + y * (double{v2[i]} - v0[i]);
    if (!(std::abs(v[i] - want) <= same_value)) return false;
  }
  return true;
}

bool CoplanarMerger::keeps_disk(const Surface& s, std::uint32_t seed, std::uint32_t f) const {
  std::uint32_t n_edges = 0, n_runs = 0, n_points = 0;
  bool before = inside(s, seed, s.end(f) - 1);
  for (std::uint32_t c = s.begin(f); c < s.end(f); ++c) {
    bool in = inside(s, seed, c);
    n_edges += in;
    n_runs += in && !before;
    n_points += point_in_[s.mesh.corners[c]] == seed;
    before = in;
  }
  return n_runs == 1 && n_points == n_edges + 1;
}

/// Along the edges whose other side is not in the region, from the first one on. False, and nothing done, where the
/// outline crosses itself because the faces lie on each other.
bool CoplanarMerger::outline(const Surface& s, std::uint32_t seed) {
  std::uint32_t first = none;
  for (std::uint32_t f : members_)
    for (std::uint32_t c = s.begin(f); c < s.end(f); ++c)
      if (!inside(s, seed, c)) first = std::min(first, c);
  const std::size_t begin = corners_.size();
  room_.clear();
  std::uint32_t c = first;
  do {
    corners_.push_back(c);
    room_.push_back(s.mesh.corners[c]);
    c = s.after(c);
    while (inside(s, seed, c)) c = s.after(mate_[c]);
  } while (c != first);
  if (cutter_.cut(s.points.data(), room_).crossing) {
    corners_.resize(begin);
    return false;
  }
  face_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
  return true;
}

/// Whether the last polygon, whose points are in room_, is concave.
void CoplanarMerger::note_concave(const Surface& s, const Vec3& normal) {
  const std::size_t n = room_.size();
  Vec3 in = s.point(room_[0]) - s.point(room_[n - 1]);
  for (std::size_t i = 0; i < n && !concave_; ++i) {
    Vec3 out = s.point(room_[i + 1 == n ? 0 : i + 1]) - s.point(room_[i]);
    concave_ = dot(cross(in, out), normal) < -reflex * std::sqrt(dot(in, in) * dot(out, out));
    in = out;
  }
}

}  // namespace wrlkit
