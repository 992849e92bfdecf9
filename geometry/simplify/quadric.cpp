// The global criterion: quadrics that remember the original (Garland and Heckbert, Surface Simplification Using Quadric
// Error Metrics, 1997). A vertex carries the squared distances from the planes of all faces that went into it, by area,
// and from the feature lines.
//
// Attributes are in the metric as in Hoppe's (New Quadric Metric for Simplifying Meshes with Appearance Attributes,
// 1999): each is a linear function g x + d over a face of the original. A wedge carries the sums of these by area; what
// its best value at x leaves is the deviation.
#include <algorithm>
#include <cmath>

#include "base/math/box.h"
#include "geometry/simplify/criterion.h"
#include "geometry/simplify/symmetric_matrix.h"

namespace wrlkit::simplify {
namespace {

constexpr double feature_weight = 4;           // of a feature line, against planes
constexpr double quadric_length_cost = 1e-12;  // of the squared length, which decides where the surface is flat
constexpr double attribute_size = 0.05;        // what a difference of 1 counts as, in sizes of the mesh

/// x A x - 2 b x + c.
struct Quadric {
  SymmetricMatrix planes;
  Vec3 linear{};
  double constant = 0;

  double operator()(const Vec3& x) const { return dot(x, planes * x) - 2 * dot(linear, x) + constant; }
  void add(const Quadric& q, double s = 1) {
    planes.add(q.planes, s);
    linear = linear + s * q.linear;
    constant += s * q.constant;
  }
  /// s (g x + d)^2.
  void add_square(const Vec3& g, double d, double s) {
    planes.add_outer(g, s);
    linear = linear + (-s * d) * g;
    constant += s * d * d;
  }
  void add_line(const Vec3& p, const Vec3& e, double weight) {
    SymmetricMatrix m = line_matrix(e, weight);
    Vec3 b = m * p;
    planes.add(m, 1);
    linear = linear + b;
    constant += dot(p, b);
  }
};

/// A function on the mesh, g x + d, times the area it is known for.
struct Linear {
  Vec3 g{};
  double d = 0;
};

class GlobalQuadric final : public Pricer {
 public:
  GlobalQuadric(const Surface& surface, const Wedges& wedges)
      : Pricer(surface), wedges_(wedges), quadric_(surface.n_vertices()), width_(wedges.width()) {
    origin_ = surface.n_vertices() ? surface.position(0) : Vec3{};
    if (width_) {
      wedge_quadric_.resize(wedges.count());
      area_.resize(wedges.count());
      linear_.resize(wedges.count() * width_);
    }
    scale_ = width_ ? attribute_size * size() : 0;
    for (std::uint32_t f = 0; f < surface.n_slots(); ++f)
      if (surface.alive(f)) add_face(f);
  }

  void before_merge(const Ring& from, const Ring& to, const Vec3&) override {
    quadric_[to.center].add(quadric_[from.center]);
    if (!width_) return;
    for_pairs(from, from.find(to.center), [&](std::uint32_t a, std::uint32_t b) {
      wedge_quadric_[b].add(wedge_quadric_[a]);
      area_[b] += area_[a];
      for (int i = 0; i < width_; ++i) {
        Linear &to_sum = linear_[b * width_ + i], &from_sum = linear_[a * width_ + i];
        to_sum.g = to_sum.g + from_sum.g;
        to_sum.d += from_sum.d;
      }
    });
  }

 protected:
  Option option(const Ring& ring, int s, Placement where) const override {
    const std::uint32_t u = ring.center, v = ring.spokes[s].vertex;
    const Vec3 a = point(u), b = point(v), middle = 0.5 * (a + b), e = b - a;
    Quadric q = quadric_[u];
    q.add(quadric_[v]);
    if (width_) for_pairs(ring, s, [&](std::uint32_t i, std::uint32_t j) { q.add(attributes(i, j)); });
    Vec3 x = where == Placement::spoke ? b : where == Placement::center ? a : middle;
    if (where == Placement::anywhere) {
      Minimum least(q.planes, q.linear + -1. * (q.planes * middle), Vec3{});  // about the middle
      if (least.exists && dot(least.x, least.x) <= 4 * dot(e, e)) x = middle + least.x;
    }
    const double cost = std::max(q(x), 0.) + quadric_length_cost * q.planes.trace() * dot(e, e);
    return {s, cost, x + origin_};
  }

 private:
  Vec3 point(std::uint32_t v) const { return surface_.position(v) - origin_; }

  /// Largest extent along an axis.
  double size() const {
    Box box{{}, {}};
    for (std::uint32_t v = 0; v < surface_.n_vertices(); ++v) box.add(point(v));
    return std::ranges::max(box.size());
  }

  void add_face(std::uint32_t f) {
    const Surface::Triangle& t = surface_.face[f];
    const Vec3 n = surface_.normal(f);
    const double area = std::sqrt(dot(n, n));
    if (!(area > 0)) return;
    Quadric q;
    q.add_square(1 / area * n, -dot(n, point(t.v[0])) / area, area);
    for (std::uint32_t v : t.v) quadric_[v].add(q);
    for (int k = 0; k < 3; ++k)
      if ((t.features | t.features >> 3) >> k & 1)
        for (std::uint32_t v : {t.v[k], t.v[(k + 1) % 3]})
          quadric_[v].add_line(point(t.v[k]), point(t.v[(k + 1) % 3]) - point(t.v[k]), feature_weight);
    if (width_) add_attributes(f, n, area);
  }

  void add_attributes(std::uint32_t f, const Vec3& n, double area) {
    const Surface::Triangle& t = surface_.face[f];
    const auto& w = wedges_.of_face[f];
    const Vec3 p = point(t.v[0]), e1 = point(t.v[1]) - p, e2 = point(t.v[2]) - p;
    const Vec3 g1 = 1 / (area * area) * cross(e2, n), g2 = 1 / (area * area) * cross(n, e1);  // dual to e1, e2
    for (int k = 0; k < 3; ++k) area_[w[k]] += area;
    for (int i = 0; i < width_; ++i) {
      const double a = scale_ * wedges_.at(w[0])[i];
      const Vec3 g = (scale_ * wedges_.at(w[1])[i] - a) * g1 + (scale_ * wedges_.at(w[2])[i] - a) * g2;
      const double d = a - dot(g, p);
      for (int k = 0; k < 3; ++k) {
        wedge_quadric_[w[k]].add_square(g, d, area);
        Linear& sum = linear_[w[k] * width_ + i];
        sum.g = sum.g + area * g;
        sum.d += area * d;
      }
    }
  }

  /// The wedges of both ends of an edge in each of its faces, every pair once.
  template <class F>
  void for_pairs(const Ring& ring, int spoke, F f) const {
    std::uint32_t last_a = none, last_b = none;
    for (const Ring::Face& face : ring.face_span()) {
      if (face.next != spoke && face.prev != spoke) continue;
      const auto& w = wedges_.of_face[face.face];
      std::uint32_t a = w[face.corner], b = w[(face.corner + (face.next == spoke ? 1 : 2)) % 3];
      if (a != last_a && b != last_b) f(a, b);
      last_a = a;
      last_b = b;
    }
  }

  /// What the attributes add for a pair of wedges that become one.
  Quadric attributes(std::uint32_t a, std::uint32_t b) const {
    Quadric q = wedge_quadric_[a];
    q.add(wedge_quadric_[b]);
    const double area = area_[a] + area_[b];
    for (int i = 0; area > 0 && i < width_; ++i) {
      const Linear &p = linear_[a * width_ + i], &r = linear_[b * width_ + i];
      q.add_square(p.g + r.g, p.d + r.d, -1 / area);
    }
    return q;
  }

  const Wedges& wedges_;
  std::vector<Quadric> quadric_;  // about origin_
  Vec3 origin_;
  int width_;
  double scale_;
  // Of each wedge.
  std::vector<Quadric> wedge_quadric_;
  std::vector<double> area_;
  std::vector<Linear> linear_;
};

}  // namespace

std::unique_ptr<Pricer> quadric(const Surface& surface, const Wedges& wedges) {
  return std::make_unique<GlobalQuadric>(surface, wedges);
}

}  // namespace wrlkit::simplify
