#include "writers/gltf/flat_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "base/math/vec.h"

namespace wrlkit::gltf {
namespace {

using Point = std::array<std::int64_t, 3>;
using Edge = std::pair<Point, Point>;

constexpr double flat = 1e-6;  // height of a triangle, as part of its longest side

Point on_grid(const float* p, double step) {
  Point out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = std::llround(p[k] / step);
  return out;
}

template <class T>
double square_of_cross(const T& a, const T& b, const T& c) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const double x = static_cast<double>(b[i] - a[i]) * static_cast<double>(c[j] - a[j]) -
                     static_cast<double>(b[j] - a[j]) * static_cast<double>(c[i] - a[i]);
    sum += x * x;
  }
  return sum;
}

template <class T>
double square(const T& a, const T& b) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += static_cast<double>(a[k] - b[k]) * static_cast<double>(a[k] - b[k]);
  return sum;
}

Edge edge(const Point& a, const Point& b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// The two ends, and what lies between them or on one of them.
struct Flat {
  Point from, to, between;
  std::size_t first;  // corner
};

Flat flat_of(const std::array<Point, 3>& t, std::size_t first) {
  std::size_t far = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (square(t[k], t[(k + 1) % 3]) > square(t[far], t[(far + 1) % 3])) far = k;
  return {t[far], t[(far + 1) % 3], t[(far + 2) % 3], first};
}

/// From a point to a triangle that has an area: its plane, if the point is above the triangle, otherwise the nearest
/// side.
double distance(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  bool above = true;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = t[(k + 1) % 3] - t[k], to = p - t[k];
    above &= dot(cross(side, to), normal) >= 0;
    const double along = std::clamp(dot(side, to) / std::max(dot(side, side), 1e-300), 0.0, 1.0);
    const Vec3 off{to[0] - along * side[0], to[1] - along * side[1], to[2] - along * side[2]};
    nearest = std::min(nearest, dot(off, off));
  }
  return above ? std::abs(dot(p - t[0], normal)) / std::sqrt(dot(normal, normal)) : std::sqrt(nearest);
}

/// Triangles as they are, and on the grid.
class Triangles {
 public:
  Triangles(std::span<const float> xyz, std::span<const std::uint32_t> corners, double step)
      : xyz_(xyz), corners_(corners), step_(step) {}

  /// All but a rest that is not a triangle, by the first corner.
  std::size_t end() const { return corners_.size() - corners_.size() % 3; }
  std::array<Vec3, 3> at(std::size_t i) const { return {point(i), point(i + 1), point(i + 2)}; }
  std::array<Point, 3> snapped(std::size_t i) const {
    return {on_grid(corner(i), step_), on_grid(corner(i + 1), step_), on_grid(corner(i + 2), step_)};
  }
  double step() const { return step_; }

 private:
  const float* corner(std::size_t i) const { return xyz_.data() + std::size_t{corners_[i]} * 3; }
  Vec3 point(std::size_t i) const { return {corner(i)[0], corner(i)[1], corner(i)[2]}; }

  std::span<const float> xyz_;
  std::span<const std::uint32_t> corners_;
  double step_;
};

bool is_flat(const std::array<Point, 3>& t) { return !(square_of_cross(t[0], t[1], t[2]) > 0); }

/// Those with an area that have none on the grid.
std::vector<Flat> vanishing(const Triangles& all, double tolerance) {
  std::vector<Flat> out;
  for (std::size_t i = 0; i < all.end(); i += 3) {
    const auto t = all.snapped(i);
    if (!is_flat(t)) continue;
    const auto p = all.at(i);
    const double longest = std::max({square(p[0], p[1]), square(p[1], p[2]), square(p[2], p[0])});
    if (longest > tolerance * tolerance && square_of_cross(p[0], p[1], p[2]) > flat * flat * longest * longest)
      out.push_back(flat_of(t, i));
  }
  return out;
}

/// Sides of triangles that stay. Only those that touch a flat triangle matter.
std::set<Edge> sides_beside(const Triangles& all, const std::vector<Flat>& flats) {
  std::set<Point> touched;
  for (const Flat& f : flats) touched.insert({f.from, f.to, f.between});
  std::set<Edge> out;
  for (std::size_t i = 0; i < all.end(); i += 3) {
    const auto t = all.snapped(i);
    if (is_flat(t)) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (touched.contains(t[k]) && touched.contains(t[(k + 1) % 3])) out.insert(edge(t[k], t[(k + 1) % 3]));
  }
  return out;
}

/// Leaves those whose place no side of others takes.
void remove_covered(std::vector<Flat>& open, std::set<Edge> covered) {
  constexpr int most_rounds = 8;  // slivers next to slivers
  for (int round = 0; round < most_rounds && !open.empty(); ++round) {
    const std::size_t before = open.size();
    std::erase_if(open, [&](const Flat& f) {
      auto has = [&](const Point& a, const Point& b) { return a == b || covered.contains(edge(a, b)); };
      const bool whole = f.from == f.to || has(f.from, f.to),
                 halves = has(f.from, f.between) && has(f.between, f.to) && f.between != f.from && f.between != f.to;
      if (!whole && !halves) return false;
      covered.insert({edge(f.from, f.to), edge(f.from, f.between), edge(f.between, f.to)});
      return true;
    });
    if (open.size() == before) break;
  }
}

/// Does a triangle that stays lie within the tolerance of a point?
bool lies_beside_a_face(const Triangles& all, const Vec3& point, double tolerance) {
  for (std::size_t i = 0; i < all.end(); i += 3) {
    const auto grid = all.snapped(i);
    std::array<Vec3, 3> t;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k) t[c][k] = static_cast<double>(grid[c][k]) * all.step();
    bool beside = true;
    for (std::size_t k = 0; k < 3 && beside; ++k)
      beside = std::min({t[0][k], t[1][k], t[2][k]}) <= point[k] + tolerance &&
               std::max({t[0][k], t[1][k], t[2][k]}) >= point[k] - tolerance;
    if (beside && square_of_cross(t[0], t[1], t[2]) > 0 && distance(point, t) <= tolerance) return true;
  }
  return false;
}

}  // namespace

bool loses_faces(std::span<const float> xyz, std::span<const std::uint32_t> triangles, double step, double tolerance) {
  const Triangles all(xyz, triangles, step);
  auto open = vanishing(all, tolerance);
  if (open.empty()) return false;
  remove_covered(open, sides_beside(all, open));
  // What is still open may lie next to another face. A point of some of them is looked at: the middle.
  constexpr std::size_t most_looked_at = 32;
  for (std::size_t o = 0, by = open.size() / most_looked_at + 1; o < open.size(); o += by) {
    const auto t = all.at(open[o].first);
    Vec3 middle{};
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (t[0][k] + t[1][k] + t[2][k]) / 3;
    if (!lies_beside_a_face(all, middle, tolerance)) return true;
  }
  return false;
}

}  // namespace wrlkit::gltf
