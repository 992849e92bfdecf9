#include "geometry/polygon.h"

#include <cmath>

#include "base/math/vec.h"
#include "geometry/polygon/holes.h"

namespace wrlkit {
namespace {

constexpr double flat_polygon = 1e-12;  // area by squared length of a polygon that counts as without area
constexpr double clear_turn = 1e-6;     // sine of a turn from which a fan may start and end anywhere
constexpr double reflex = 1e-2;         // sine of a turn that is not a rounding error of the coordinates
constexpr double planar = 1e-3;         // distance from the plane by length

double sum_of_squares(const Vec3& a) { return dot(a, a); }
double square(double v) { return v * v; }

struct Plane {
  Vec3 normal{};      // twice the area long
  double extent = 0;  // greatest squared distance from the first corner
};

/// Newell's normal, computed around the first corner: coordinates may be large.
Plane plane_of(std::span<const Vec3> polygon) {
  Plane plane;
  Vec3 last{};
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    Vec3 d = polygon[i] - polygon[0];
    plane.normal = plane.normal + cross(last, d);
    double length = sum_of_squares(d);
    if (!(length <= plane.extent)) plane.extent = length;
    last = d;
  }
  return plane;
}

/// The largest of the triangles at the first corner, for polygons whose areas cancel out.
Vec3 largest_normal(std::span<const Vec3> polygon) {
  Vec3 best{};
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    Vec3 n = cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    if (sum_of_squares(n) > sum_of_squares(best)) best = n;
  }
  return best;
}

bool is_planar(std::span<const Vec3> polygon, const Plane& plane) {
  double limit = planar * planar * sum_of_squares(plane.normal) * plane.extent;
  for (const Vec3& p : polygon)
    if (square(dot(plane.normal, p - polygon[0])) > limit) return false;
  return true;
}

/// Drops the coordinate along which the polygon is widest seen: what is left of the others is exact.
void drop_axis(std::span<const Vec3> polygon, const Vec3& normal, std::vector<Vec2>& out) {
  int axis = std::abs(normal[0]) > std::abs(normal[1]) ? 0 : 1;
  if (std::abs(normal[2]) >= std::abs(normal[axis])) axis = 2;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  for (std::size_t i = 0; i < polygon.size(); ++i) out[i] = {polygon[i][u], polygon[i][v]};
}

void project_along(std::span<const Vec3> polygon, const Vec3& normal, std::vector<Vec2>& out) {
  Vec3 w = unit(normal), side = std::abs(w[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 u = unit(cross(side, w)), v = cross(w, u);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Vec3 d = polygon[i] - polygon[0];
    out[i] = {dot(u, d), dot(v, d)};
  }
}

}  // namespace

PolygonCutter::Result PolygonCutter::cut(const double* positions, std::span<const std::uint32_t> corners) {
  result_ = {};
  corners_.clear();
  polygon_.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double* p = positions + std::size_t{3} * corners[i];
    polygon_[i] = {p[0], p[1], p[2]};
  }
  if (corners.size() < 3 || !project()) return result_;
  if (strictly_convex()) {
    fan();
    return result_;
  }
  rings_.clear();
  auto ring = add_ring(0, static_cast<std::uint32_t>(points_.size()), false);
  result_.concave = has_reflex_corner();
  result_.crossing |= turns() != 1;
  result_.crossing |= !clipper_.clip(rings_, ring, corners_);
  return result_;
}

PolygonCutter::Result PolygonCutter::cut(std::span<const Vec2> points, std::span<const std::uint32_t> ring_ends) {
  result_ = {};
  corners_.clear();
  points_.assign(points.begin(), points.end());
  rings_.clear();
  holes_.clear();
  std::uint32_t begin = 0, outline = 0;
  for (std::size_t i = 0; i < ring_ends.size(); begin = ring_ends[i++]) {
    if (ring_ends[i] - begin < 3 && i > 0) continue;
    if (ring_ends[i] - begin < 3) return result_;
    bool anticlockwise = area(begin, ring_ends[i]) > 0, is_outline = i == 0;
    auto ring = add_ring(begin, ring_ends[i], anticlockwise != is_outline);
    if (is_outline)
      outline = ring;
    else
      holes_.push_back(ring);
  }
  if (rings_.nodes.empty()) return result_;
  join_holes(rings_, outline, holes_);
  result_.crossing = !clipper_.clip(rings_, outline, corners_);
  return result_;
}

/// The corners in a plane, so that they run anticlockwise. False when there is no area.
bool PolygonCutter::project() {
  Plane plane = plane_of(polygon_);
  if (!std::isfinite(plane.extent) || !std::isfinite(sum_of_squares(plane.normal))) return false;
  auto has_area = [&] { return sum_of_squares(plane.normal) > square(flat_polygon * plane.extent); };
  if (!has_area()) {
    plane.normal = largest_normal(polygon_);
    if (!has_area()) return false;
    result_.crossing = true;
  }
  points_.resize(polygon_.size());
  result_.planar = is_planar(polygon_, plane);
  if (result_.planar)
    drop_axis(polygon_, plane.normal, points_);
  else
    project_along(polygon_, plane.normal, points_);
  return true;
}

/// Every corner turns left, clearly, and the edges go to the right and back only once.
bool PolygonCutter::strictly_convex() const {
  Vec2 a = points_[points_.size() - 2], b = points_.back();
  bool right = b[0] > a[0];
  int reversals = 0;
  for (const Vec2& c : points_) {
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1], turn = ux * vy - uy * vx;
    if (!(turn > 0 && turn * turn > clear_turn * clear_turn * (ux * ux + uy * uy) * (vx * vx + vy * vy))) return false;
    reversals += right != (vx > 0);
    right = vx > 0;
    a = b;
    b = c;
  }
  return reversals == 2;
}

bool PolygonCutter::has_reflex_corner() const {
  Vec2 a = points_[points_.size() - 2], b = points_.back();
  for (const Vec2& c : points_) {
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1], turn = ux * vy - uy * vx;
    if (turn < 0 && turn * turn > reflex * reflex * (ux * ux + uy * uy) * (vx * vx + vy * vy)) return true;
    a = b;
    b = c;
  }
  return false;
}

/// How many times the edges turn around: once, unless the polygon crosses itself. Counted where they pass the direction
/// of the x axis. A spike turns either way; then it is undecided, and the answer is once.
int PolygonCutter::turns() const {
  auto upward = [](const Vec2& p, const Vec2& q) { return q[1] > p[1] || (q[1] == p[1] && q[0] > p[0]); };
  std::size_t n = points_.size(), first = 0;
  while (first + 1 < n && points_[first] == points_[n - 1]) ++first;
  Vec2 a = points_[n - 1], b = points_[first];
  int count = 0;
  for (std::size_t i = 1; i <= n; ++i) {
    const Vec2& c = points_[(first + i) % n];
    if (c == b) continue;
    double turn = orientation(a, b, c);
    if (turn == 0 && (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) < 0) return 1;
    bool up = upward(a, b), up_next = upward(b, c);
    if (turn > 0 && !up && up_next) ++count;
    if (turn < 0 && up && !up_next) --count;
    a = b;
    b = c;
  }
  return count;
}

double PolygonCutter::area(std::uint32_t begin, std::uint32_t end) const {
  double sum = 0;
  for (auto i = begin + 1; i + 1 < end; ++i) sum += orientation(points_[begin], points_[i], points_[i + 1]);
  return sum;
}

/// A ring of the points [begin, end); returns its first node.
std::uint32_t PolygonCutter::add_ring(std::uint32_t begin, std::uint32_t end, bool reverse) {
  auto first = static_cast<std::uint32_t>(rings_.nodes.size());
  for (auto i = begin; i < end; ++i) {
    auto point = reverse ? begin + (end - 1 - i) : i;
    auto node = rings_.add(point, points_[point]);
    if (node > first) rings_.link(node - 1, node);
  }
  rings_.link(first + (end - begin) - 1, first);
  return first;
}

void PolygonCutter::fan() {
  auto n = static_cast<std::uint32_t>(points_.size());
  corners_.resize(3 * std::size_t{n - 2});
  auto* out = corners_.data();
  for (std::uint32_t i = 1; i + 1 < n; ++i, out += 3) {
    out[0] = 0;
    out[1] = i;
    out[2] = i + 1;
  }
}

}  // namespace wrlkit
