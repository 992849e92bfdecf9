#include "convert/tiles/farthest_point.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::tiles {
namespace {

constexpr std::size_t most_parts = 80'000;  // of a triangle
constexpr double tolerance = 0.02;          // of the distance

/// How far along the way from `a` to `b` two triangles are equally far, of which `of_a` is nearer to `a`.
double between(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& of_a, const std::array<Vec3, 3>& of_b) {
  constexpr int halvings = 22;
  double low = 0, high = 1;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    const Vec3 p = a + middle * (b - a);
    (squared_distance(p, of_a) <= squared_distance(p, of_b) ? low : high) = middle;
  }
  return (low + high) / 2;
}

std::array<Vec3, 8> corners_of_box(const Mesh& mesh, const Vec3& origin) {
  const Box box = box_of_corners(mesh);
  std::array<Vec3, 8> out;
  for (int i = 0; i < 8; ++i) out[static_cast<std::size_t>(i)] = box.corner(i) - origin;
  return out;
}

}  // namespace

FarthestPoint::FarthestPoint(const Soup& surface, double least)
    : triangles_(surface.triangles()), nearest_(triangles_), least_(least) {}

double FarthestPoint::bound() const { return std::max(farthest_, bound_); }

/// What need not be told from the farthest point.
double FarthestPoint::enough() const { return farthest_ + tolerance * std::max(farthest_, least_); }

void FarthestPoint::add(std::span<const Piece> pieces, const Vec3& origin) {
  std::vector<const Piece*> open;
  for (const auto& p : pieces)
    if (p.mesh.is_triangles() && !is_near(corners_of_box(p.mesh, origin), guess_)) open.push_back(&p);
  // The farther the farthest corner is that is known, the less there is to be cut.
  std::vector<std::vector<std::uint32_t>> near(open.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Mesh& mesh = open[i]->mesh;
    for (std::uint32_t k = 0; k < mesh.n_positions(); ++k) near[i].push_back(ask(mesh.position(k) - origin));
  }
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto triangles = triangles_of(open[i]->mesh);
    const auto corners = triangles.corners;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
      const auto t = triangles[k];
      add({{t[0] - origin, t[1] - origin, t[2] - origin},
           {near[i][corners[3 * k]], near[i][corners[3 * k + 1]], near[i][corners[3 * k + 2]]}});
    }
  }
}

/// A triangle that is as near to a point as any, or as the farthest point is.
std::uint32_t FarthestPoint::ask(const Vec3& p) {
  if (!is_usable({p, p, p})) return ClosestPoint::no_guess;
  const auto found = nearest_.nearest(p, {}, guess_, farthest_);
  farthest_ = std::max(farthest_, found.distance);
  guess_ = found.triangle;
  return found.triangle;
}

/// Whether all that is between the points is near to a triangle.
bool FarthestPoint::is_near(std::span<const Vec3> points, std::uint32_t triangle) {
  if (triangle == ClosestPoint::no_guess) return false;
  const auto to = triangles_[triangle];
  const double most = enough() * enough();
  double farthest = 0;
  for (const Vec3& p : points) {
    farthest = std::max(farthest, squared_distance(p, to));
    if (!(farthest <= most)) return false;
  }
  bound_ = std::max(bound_, std::sqrt(farthest));
  return true;
}

void FarthestPoint::add(const Part& all) {
  if (!std::isfinite(farthest_) || !is_usable(all.corners)) return;
  open_.assign(1, all);
  // The largest parts first: when there are too many, those that are left are small.
  for (std::size_t next = 0; next < open_.size();) {
    const Part part = open_[next++];
    if (is_known(part)) continue;
    if (open_.size() < most_parts)
      cut(part);
    else
      give_up(part);
  }
}

bool FarthestPoint::is_known(const Part& part) {
  const auto& n = part.near;
  return is_near(part.corners, n[0]) || (n[1] != n[0] && is_near(part.corners, n[1])) ||
         (n[2] != n[0] && n[2] != n[1] && is_near(part.corners, n[2]));
}

/// No point is farther from the surface than the middle is, and the way from there.
void FarthestPoint::give_up(const Part& part) {
  const Vec3 middle = (1. / 3) * (part.corners[0] + part.corners[1] + part.corners[2]);
  double radius = 0;
  for (const Vec3& p : part.corners) radius = std::max(radius, fast_length(p - middle));
  bound_ = std::max(bound_, nearest_.nearest(middle, {}, guess_).distance + radius);
}

void FarthestPoint::cut(const Part& part) {
  constexpr double at_end = 1e-3;  // nothing would be cut off there
  const auto& c = part.corners;
  const auto& near = part.near;
  std::size_t edge = 0;
  double longest = -1, where = 0.5;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double length = fast_length(c[next] - c[k]);
    if (near[k] == near[next] || length <= longest) continue;
    const double t = between(c[k], c[next], triangles_[near[k]], triangles_[near[next]]);
    if (t < at_end || t > 1 - at_end) continue;
    longest = length;
    edge = k;
    where = t;
  }
  for (std::size_t k = 0; longest < 0 && k < 3; ++k)
    if (fast_length(c[(k + 1) % 3] - c[k]) > fast_length(c[(edge + 1) % 3] - c[edge])) edge = k;
  const std::size_t next = (edge + 1) % 3, opposite = (edge + 2) % 3;
  const Vec3 p = c[edge] + where * (c[next] - c[edge]);
  const auto near_p = ask(p);
  open_.push_back({{c[edge], p, c[opposite]}, {near[edge], near_p, near[opposite]}});
  open_.push_back({{p, c[next], c[opposite]}, {near_p, near[next], near[opposite]}});
}

}  // namespace wrlkit::tiles
