#include "passes/lower_x3d/revolution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/math/vec.h"
#include "scenegraph/nodes.h"

namespace wrlkit::x3d {
namespace {

constexpr int turn_sides = 64;

class Turned {
 public:
  explicit Turned(const Revolution& r) : angle_(std::clamp(r.angle, -2 * std::numbers::pi, 2 * std::numbers::pi)) {
    for (std::size_t i = 0; i + 1 < std::min(r.profile.size(), 2 * Revolution::most_points); i += 2)
      if (std::isfinite(r.profile[i]) && std::isfinite(r.profile[i + 1]))
        profile_.push_back({r.profile[i], r.profile[i + 1]});
    closed_ = profile_.size() > 2 && profile_.front() == profile_.back();
    whole_ = 2 * std::numbers::pi - std::abs(angle_) < 1e-6;
    steps_ = std::max(3, static_cast<int>(std::ceil(turn_sides * std::abs(angle_) / (2 * std::numbers::pi) - 1e-9)));
    if (closed_) {
      profile_.pop_back();
    } else if (profile_.size() > 1) {
      if (profile_.back()[1] != 0) profile_.push_back({profile_.back()[0], 0});
      if (profile_.front()[1] != 0) profile_.insert(profile_.begin(), {profile_.front()[0], 0});
    }
  }

  bool any() const { return profile_.size() > 1 && angle_ != 0; }
  double step() const { return std::abs(angle_) / steps_; }

  void make(bool caps) {
    const int rings = whole_ ? steps_ : steps_ + 1;
    for (int i = 0; i < rings; ++i) {
      const double a = angle_ * i / steps_;
      for (const Vec2& p : profile_) points.insert(points.end(), {p[0], -std::sin(a) * p[1], std::cos(a) * p[1]});
    }
    const std::size_t n = profile_.size(), edges = closed_ ? n : n - 1;
    for (int i = 0; i < steps_; ++i)
      for (std::size_t j = 0; j < edges; ++j) {
        const std::size_t next = (j + 1) % n;
        face({at(i, j), at(i, next), at((i + 1) % rings, next), at((i + 1) % rings, j)});
      }
    if (whole_ || !caps) return;
    std::vector<std::int32_t> begin, end;
    for (std::size_t j = 0; j < n; ++j) {
      begin.push_back(at(0, n - 1 - j));
      end.push_back(at(steps_, j));
    }
    face(begin);
    face(end);
  }

  std::vector<double> points;
  std::vector<std::int32_t> index;
  double volume = 0;  // six times; negative: the faces look inwards

 private:
  /// Points on the axis are the same for all rings.
  std::int32_t at(int ring, std::size_t j) const {
    const std::size_t of_ring = profile_[j][1] == 0 ? 0 : static_cast<std::size_t>(ring);
    return static_cast<std::int32_t>(of_ring * profile_.size() + j);
  }
  Vec3 point(std::int32_t i) const {
    const auto k = 3 * static_cast<std::size_t>(i);
    return {points[k], points[k + 1], points[k + 2]};
  }
  void face(std::vector<std::int32_t> corners) {
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() < 3) return;
    for (std::size_t i = 2; i < corners.size(); ++i)
      volume += dot(point(corners[0]), cross(point(corners[i - 1]), point(corners[i])));
    index.insert(index.end(), corners.begin(), corners.end());
    index.push_back(-1);
  }

  double angle_;
  std::vector<Vec2> profile_;
  bool closed_ = false, whole_ = false;
  int steps_ = 3;
};

}  // namespace

NodeId faces_of(Scene& scene, const Revolution& r, Span where) {
  namespace f = nodes::indexed_face_set;
  Turned turned(r);
  if (!turned.any()) return {};
  turned.make(r.caps);
  const NodeId to = scene.add(nodes::IndexedFaceSet, where), coord = scene.add(nodes::Coordinate, where);
  scene.set(coord, nodes::coordinate::point, turned.points);
  scene.set(to, f::coord, coord, f::coordIndex, turned.index, f::creaseAngle,
            std::max(r.crease_angle, 1.01 * turned.step()));  // round around the axis
  if (turned.volume < 0) scene.set(to, f::ccw, false);
  scene.set(to, f::convex, false);
  return to;
}

}  // namespace wrlkit::x3d
