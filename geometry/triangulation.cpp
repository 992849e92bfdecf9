// For each corner of a triangle, its original is noted; then each index stream is gathered by that list. Triangles
// and quadrilaterals are decided here, without a square root or a copy of their positions; larger faces by the
// PolygonCutter.
#include "geometry/triangulation.h"

#include <algorithm>

#include "base/math/vec.h"
#include "geometry/geometry_attributes.h"

namespace wrlkit {
namespace {

constexpr double no_area = 1e-12;     // area by the square of the longest edge
constexpr double clear_part = 1e-6;   // of the area of a quadrilateral, that each half of it should have
constexpr double reflex_part = 1e-3;  // the same, negative: a corner that is concave beyond doubt
constexpr double fold = 1e-4;         // squared sine of the angle between two halves that are not in one plane

Vec3 between(const double* a, const double* b) { return {b[0] - a[0], b[1] - a[1], b[2] - a[2]}; }

Vec3 single(const double* p) { return {static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])}; }

/// Numbers of VRML97 are single precision (5.14). Three points of one line are, when rounded to that, often a little
/// off it: other readers draw such a triangle, and so do we.
bool has_area_in_single(const double* a, const double* b, const double* c) {
  Vec3 o = single(a), n = cross(single(b) - o, single(c) - o);
  return dot(n, n) > 0;
}

/// Whether two triangles with an edge in common are not in one plane, by their normals.
bool folded(const Vec3& m, const Vec3& n) {
  double c = dot(m, n);
  return !(c > 0 && c * c > (1 - fold) * dot(m, m) * dot(n, n));
}

double cosine(const Vec3& m, const Vec3& n) { return dot(m, n) / std::sqrt(dot(m, m) * dot(n, n)); }

class Triangulation {
 public:
  explicit Triangulation(MeshJob& job)
      : job_(job),
        mesh_(job.mesh),
        sources_(job.scratch.a),
        positions_(mesh_.positions.data()),
        corners_(mesh_.corners.data()) {}

  bool run() {
    bool had_polygons = !mesh_.face_begin.empty();
    std::size_t most = 0;
    if (only_triangles(most))
      drop_flat_triangles();
    else
      cut_faces(most);
    report();
    return had_polygons || n_flat_;
  }

 private:
  bool only_triangles(std::size_t& most) const;
  void drop_flat_triangles();
  void cut_faces(std::size_t most);
  void cut_face(std::uint32_t begin, std::uint32_t n);
  void cut_triangle(std::uint32_t begin);
  void cut_quad(std::uint32_t begin);
  void cut_polygon(std::uint32_t begin, std::uint32_t n);
  void gather();
  void report();

  const double* at(std::size_t corner) const { return positions_ + std::size_t{3} * corners_[corner]; }
  void triangle(std::uint32_t begin, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    out_[0] = begin + a;
    out_[1] = begin + b;
    out_[2] = begin + c;
    out_ += 3;
  }

  MeshJob& job_;
  Mesh& mesh_;
  std::vector<std::uint32_t>& sources_;  // of each new corner, the old one
  std::uint32_t* out_ = nullptr;         // into sources_
  const double* positions_;
  const std::uint32_t* corners_;
  std::size_t n_flat_ = 0, n_concave_ = 0, n_crossing_ = 0, n_warped_ = 0;
};

/// False when there is work; `most` is the number of triangles that it can give.
bool Triangulation::only_triangles(std::size_t& most) const {
  const auto& begin = mesh_.face_begin;
  bool only = true;
  for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
    auto n = begin[f + 1] - begin[f];
    only &= n == 3;
    most += n < 3 ? 0 : n - 2;
  }
  return only;
}

void Triangulation::drop_flat_triangles() {
  mesh_.face_begin.clear();
  std::size_t n = mesh_.corners.size() / 3, i = 0;
  while (i < n && has_area(at(3 * i), at(3 * i + 1), at(3 * i + 2))) ++i;
  if (i == n) return;
  sources_.resize(3 * n);
  out_ = sources_.data();
  mesh_.cut.resize(n);  // parts of merged meshes are counted by the faces that there were
  for (std::size_t f = 0; f < n; ++f) {
    const auto* before = out_;
    cut_triangle(static_cast<std::uint32_t>(3 * f));
    mesh_.cut[f] = out_ != before;
  }
  gather();
}

void Triangulation::cut_faces(std::size_t most) {
  sources_.resize(3 * most);
  out_ = sources_.data();
  const auto& begin = mesh_.face_begin;
  mesh_.cut.resize(begin.size() - 1);
  for (std::size_t f = 0; f + 1 < begin.size(); ++f) {
    const auto* before = out_;
    cut_face(begin[f], begin[f + 1] - begin[f]);
    mesh_.cut[f] = static_cast<std::uint32_t>((out_ - before) / 3);
  }
  gather();
  mesh_.face_begin.clear();
}

void Triangulation::cut_face(std::uint32_t begin, std::uint32_t n) {
  if (n == 4)
    cut_quad(begin);
  else if (n == 3)
    cut_triangle(begin);
  else if (n > 4)
    cut_polygon(begin, n);
  else
    ++n_flat_;
}

void Triangulation::cut_triangle(std::uint32_t begin) {
  if (has_area(at(begin), at(begin + 1), at(begin + 2)))
    triangle(begin, 0, 1, 2);
  else
    ++n_flat_;
}

/// A diagonal is good when both its halves turn the way of the whole; both are when the quadrilateral is convex, none
/// when it crosses itself or has no area.
void Triangulation::cut_quad(std::uint32_t begin) {
  const double* p = at(begin);
  Vec3 d1 = between(p, at(begin + 1)), d2 = between(p, at(begin + 2)), d3 = between(p, at(begin + 3));
  Vec3 n1 = cross(d1, d2), n3 = cross(d2, d3), n = n1 + n3, n0 = cross(d1, d3);  // ni is that of corner i
  double all = dot(n, n), extent = dot(d1, d1) + dot(d2, d2) + dot(d3, d3);
  if (!(all > no_area * no_area * extent * extent)) return cut_polygon(begin, 4);
  double part1 = dot(n1, n), part3 = all - part1, part0 = dot(n0, n), part2 = all - part0;
  bool first = std::min(part1, part3) > clear_part * all, second = std::min(part0, part2) > clear_part * all;
  if (!first && !second) return cut_polygon(begin, 4);
  if (first != second && std::min({part0, part1, part2, part3}) < -reflex_part * all) ++n_concave_;
  Vec3 n2 = n - n0;
  if (first ? folded(n1, n3) : folded(n0, n2)) {
    ++n_warped_;
    if (second && cosine(n0, n2) > cosine(n1, n3)) first = false;
  }
  if (first) {
    triangle(begin, 0, 1, 2);
    triangle(begin, 0, 2, 3);
  } else {
    triangle(begin, 0, 1, 3);
    triangle(begin, 1, 2, 3);
  }
}

void Triangulation::cut_polygon(std::uint32_t begin, std::uint32_t n) {
  auto& cutter = job_.scratch.cutter;
  auto result = cutter.cut(positions_, {corners_ + begin, n});
  if (cutter.corners().empty()) {
    ++n_flat_;
    return;
  }
  n_crossing_ += result.crossing;
  n_concave_ += result.concave && !result.crossing;
  n_warped_ += !result.planar;
  for (auto c : cutter.corners()) *out_++ = begin + c;
}

/// Brings every index stream into the new order.
void Triangulation::gather() {
  std::size_t n = out_ - sources_.data();
  auto& next = job_.scratch.b;
  auto reorder = [&](std::vector<std::uint32_t>& stream) {
    next.resize(n);
    for (std::size_t i = 0; i < n; ++i) next[i] = stream[sources_[i]];
    stream.swap(next);
  };
  reorder(mesh_.corners);
  for (Attribute* a : mesh_.attributes())
    if (a->present()) reorder(a->index);
}

void Triangulation::report() {
  auto& diag = job_.ctx.diag;
  auto where = job_.scene.where(job_.geometry);
  if (n_flat_) diag.report(Diag::degenerate_face, where, title(job_), n_flat_);
  if (n_concave_ && mesh_.convex) diag.report(Diag::concave_face, where, title(job_), n_concave_);
  if (n_crossing_) diag.report(Diag::self_touching_face, where, title(job_), n_crossing_);
  if (!n_warped_) return;
  auto& stats = job_.ctx.stats;
  auto i = stats.find("triangulate.non-planar");
  if (i == stats.end()) i = stats.emplace("triangulate.non-planar", 0).first;
  i->second += n_warped_;
}

}  // namespace

bool has_area(const double* a, const double* b, const double* c) {
  Vec3 ab = between(a, b), ac = between(a, c), bc = between(b, c), n = cross(ab, ac);
  double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  return dot(n, n) > no_area * no_area * longest * longest || has_area_in_single(a, b, c);
}

void drop_faces_without_area(Mesh& mesh) {
  const double* p = mesh.positions.data();
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i + 2 < mesh.corners.size(); i += 3) {
    const auto at = [&](std::uint32_t corner) { return p + std::size_t{mesh.corners[corner]} * 3; };
    if (has_area(at(i), at(i + 1), at(i + 2))) kept.insert(kept.end(), {i, i + 1, i + 2});
  }
  if (kept.size() == mesh.corners.size()) return;
  const auto take = [&](std::vector<std::uint32_t>& stream) {
    for (std::size_t i = 0; i < kept.size(); ++i) stream[i] = stream[kept[i]];
    stream.resize(kept.size());
  };
  take(mesh.corners);
  for (Attribute* a : mesh.attributes())
    if (a->present()) take(a->index);
}

bool cut_into_triangles(MeshJob& job) {
  if (job.mesh.kind != Mesh::Kind::faces) return false;
  return Triangulation(job).run();
}

}  // namespace wrlkit
