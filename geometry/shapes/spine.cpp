#include "geometry/shapes/spine.h"

#include <algorithm>

#include "base/math/vec.h"

namespace wrlkit {
namespace {

constexpr double straight = 1e-5;  // sine of an angle that is none
constexpr double digits = 2e-6;    // what six printed digits may be off, relative to the coordinate

// The shortest turn from Y to the unit vector y. Its axis is Y x y = (y.z, 0, -y.x).
SpinePlane turned_to(const Vec3& y) {
  if (y[1] < -1 + 1e-12) return {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  const double k = 1 / (1 + y[1]);
  return {{1 - y[0] * y[0] * k, -y[0], -y[0] * y[2] * k}, y, {-y[0] * y[2] * k, -y[2], 1 - y[2] * y[2] * k}};
}

// Planes of a spine without equal neighbours.
class Spine {
 public:
  explicit Spine(std::span<const Vec3> points)
      : p_(points), n_(points.size()), closed_(n_ > 2 && points[0] == points[n_ - 1]) {
    for (auto& p : p_)
      for (double v : p) reach_ = std::max(reach_, std::abs(v));
  }

  std::vector<SpinePlane> planes() const {
    if (n_ < 2) return {SpinePlane{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::vector<Vec3> y(n_), z(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      y[i] = along(i);
      z[i] = across(i);
    }
    for (std::size_t i = 1; i < n_; ++i)  // a hairpin has no direction at its tip
      if (length(y[i]) == 0) y[i] = y[i - 1];
    std::vector<SpinePlane> out(n_);
    const bool bent = fill_z(z);
    for (std::size_t i = 0; i < n_; ++i) {
      // One turn for all of a straight spine, also where it runs back; a curve too fine to have a Z axis turns all the
      // same.
      const bool parallel = length(cross(y[i], y[0])) < 1e-3;
      out[i] = bent ? plane(y[i], z[i]) : turned_to(parallel ? y[0] : y[i]);
    }
    return out;
  }

 private:
  // Neighbours of a point; those of the ends lie across the seam when the spine is closed, otherwise the end stands for
  // itself.
  const Vec3& before(std::size_t i) const { return p_[i > 0 ? i - 1 : closed_ ? n_ - 2 : 0]; }
  const Vec3& after(std::size_t i) const { return p_[i + 1 < n_ ? i + 1 : closed_ ? 1 : n_ - 1]; }

  // Y axis (a, b, c); zero where both neighbours are the same point.
  Vec3 along(std::size_t i) const {
    Vec3 y = unit(after(i) - before(i));
    return length(y) == 0 && i == 0 ? unit(p_[1] - p_[0]) : y;
  }

  // Z axis (d, e); zero where the three points are collinear, and at the ends of an open spine.
  Vec3 across(std::size_t i) const {
    const Vec3 a = after(i) - p_[i], b = before(i) - p_[i];
    const double la = length(a), lb = length(b);
    if (la == 0 || lb == 0) return {0, 0, 0};
    const double sine_error = std::min(0.5, straight + digits * reach_ / std::min(la, lb));
    const Vec3 z = cross(unit(a), unit(b));
    return length(z) < sine_error ? Vec3{0, 0, 0} : unit(z);
  }

  // Inherits undefined axes and turns those that flip (f, g). False when there is none at all: the spine is straight.
  bool fill_z(std::vector<Vec3>& z) const {
    auto defined = [](const Vec3& v) { return length(v) > 0; };
    auto first = std::ranges::find_if(z, defined);
    if (first == z.end()) return false;
    std::fill(z.begin(), first, *first);
    for (std::size_t i = 1; i < n_; ++i) {
      if (!defined(z[i])) z[i] = z[i - 1];
      if (dot(z[i], z[i - 1]) < 0) z[i] = -1.0 * z[i];
    }
    if (closed_) z[n_ - 1] = z[0];
    return true;
  }

  // y and z are square to each other up to what counts as collinear.
  static SpinePlane plane(const Vec3& y, const Vec3& z) {
    const Vec3 x = unit(cross(y, z));
    return length(x) > 0 ? SpinePlane{x, y, cross(x, y)} : turned_to(y);
  }

  std::span<const Vec3> p_;
  std::size_t n_;
  bool closed_;
  double reach_ = 0;
};

}  // namespace

std::vector<SpinePlane> spine_planes(std::span<const Vec3> spine) {
  std::vector<Vec3> distinct;
  for (auto& p : spine)
    if (distinct.empty() || p != distinct.back()) distinct.push_back(p);
  const auto planes = Spine(distinct).planes();

  std::vector<SpinePlane> out;
  for (std::size_t i = 0, at = 0; i < spine.size(); ++i) {
    if (i > 0 && spine[i] != spine[i - 1]) ++at;
    out.push_back(planes[at]);
  }
  return out;
}

}  // namespace wrlkit
