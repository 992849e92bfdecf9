#include "geometry/half_space.h"

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace wrlkit {
namespace {

/// A corner of the new mesh: one of the old mesh, or one between two of them.
struct Corner {
  std::uint32_t a, b;  // corners of the old mesh; equal: that one
};

class PlaneCut {
 public:
  PlaneCut(const Mesh& mesh, const Vec4& plane) : old_(mesh) {
    for (std::uint32_t p : mesh.corners) {
      const Vec3 at = mesh.position(p);
      side_.push_back(plane[0] * at[0] + plane[1] * at[1] + plane[2] * at[2] + plane[3]);
    }
  }

  bool in_front() const {
    return std::ranges::all_of(side_, [](double d) { return d >= 0; });
  }

  Mesh run() {
    out_.kind = old_.kind;
    out_.ccw = old_.ccw;
    out_.solid = old_.solid;
    out_.crease_angle = old_.crease_angle;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      *out_.attributes()[i] = Attribute(old_.attributes()[i]->width);
      out_.attributes()[i]->values = old_.attributes()[i]->values;
    }
    if (old_.kind == Mesh::Kind::faces)
      triangles();
    else if (old_.kind == Mesh::Kind::lines)
      lines();
    else
      points();
    return std::move(out_);
  }

 private:
  bool front(std::uint32_t corner) const { return side_[corner] >= 0; }

  /// The part of the polygon or line from one corner to the next that is in front, but for its end.
  void part(std::uint32_t a, std::uint32_t b, std::vector<Corner>& to) const {
    if (front(a)) to.push_back({a, a});
    if (front(a) != front(b) && side_[a] != 0 && side_[b] != 0) to.push_back({a, b});
  }

  void triangles() {
    std::vector<Corner> polygon;
    for (std::uint32_t i = 0; i + 2 < old_.corners.size(); i += 3) {
      polygon.clear();
      part(i, i + 1, polygon);
      part(i + 1, i + 2, polygon);
      part(i + 2, i, polygon);
      for (std::size_t k = 2; k < polygon.size(); ++k)
        for (const Corner& c : {polygon[0], polygon[k - 1], polygon[k]}) add(c);
    }
  }

  void lines() {
    std::vector<Corner> ends;
    for (std::size_t face = 0; face < old_.n_faces(); ++face)
      for (std::size_t i = old_.begin_of(face); i + 1 < old_.end_of(face); ++i) {
        const auto a = static_cast<std::uint32_t>(i), b = a + 1;
        ends.clear();
        part(a, b, ends);
        if (front(b)) ends.push_back({b, b});
        if (ends.size() == 2)
          for (const Corner& c : ends) add(c);
      }
  }

  void points() {
    for (std::uint32_t i = 0; i < old_.corners.size(); ++i)
      if (front(i)) add({i, i});
  }

  void add(Corner c) {
    // In one order, so that both neighbours have the same numbers.
    if (old_.corners[c.a] > old_.corners[c.b]) std::swap(c.a, c.b);
    const double t = c.a == c.b ? 0 : side_[c.a] / (side_[c.a] - side_[c.b]);
    const std::uint32_t position = position_of(c, t);
    out_.corners.push_back(position);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const Attribute& from = *old_.attributes()[i];
      if (from.present()) out_.attributes()[i]->index.push_back(value_of(i, from, c, position, t));
    }
  }

  std::uint32_t position_of(const Corner& c, double t) {
    const auto p = old_.corners[c.a], q = old_.corners[c.b];
    const auto next = static_cast<std::uint32_t>(out_.n_positions());
    const std::uint64_t key = p == q ? p : (std::uint64_t{p} + 1) << 32 | q;
    const auto [i, fresh] = moved_.emplace(key, next);
    if (!fresh) return i->second;
    const Vec3 a = old_.position(p), b = old_.position(q);
    for (std::size_t k = 0; k < 3; ++k) out_.positions.edit().push_back(a[k] + (b[k] - a[k]) * t);
    return next;
  }

  std::uint32_t value_of(std::size_t attribute, const Attribute& from, const Corner& c, std::uint32_t position,
                         double t) {
    const auto a = from.index[c.a], b = from.index[c.b];
    if (a == b) return a;
    auto& to = *out_.attributes()[attribute];
    const auto next = static_cast<std::uint32_t>(to.count());
    const auto [i, fresh] = values_[attribute].emplace(std::array{position, a, b}, next);
    if (!fresh) return i->second;
    for (int k = 0; k < from.width; ++k) {
      const double x = from.at(a)[k], y = from.at(b)[k];
      to.values.push_back(static_cast<float>(x + (y - x) * t));
    }
    return next;
  }

  const Mesh& old_;
  Mesh out_;
  std::vector<double> side_;                                // of each corner: below 0 behind the plane
  std::unordered_map<std::uint64_t, std::uint32_t> moved_;  // new positions, of old ones and of edges between them
  std::array<std::map<std::array<std::uint32_t, 3>, std::uint32_t>, 4> values_;  // by position and two old values
};

}  // namespace

Vec4 plane_below(const Vec4& plane, const Matrix& m) {
  Vec4 out{0, 0, 0, plane[3]};
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t r = 0; r < 3; ++r) out[c] += plane[r] * m(static_cast<int>(r), static_cast<int>(c));
  return out;
}

bool cut_by_plane(Mesh& mesh, const Vec4& plane) {
  PlaneCut cut(mesh, plane);
  if (cut.in_front()) return false;
  mesh = cut.run();
  return true;
}

}  // namespace wrlkit
