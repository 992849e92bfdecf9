#include "geometry/simplify/samples.h"

#include <algorithm>
#include <cmath>

#include "base/math/vec.h"
#include "geometry/simplify/closest_on_triangle.h"

namespace wrlkit::simplify {
namespace {

constexpr double share_of_corners = 0.05;  // of the weight

double fraction(double x) { return x - std::floor(x); }

/// Equal steps through the area; within a triangle the additive sequence of the plastic number.
class Spread {
 public:
  explicit Spread(const Triangles& surface) : surface_(surface) {
    end_.reserve(surface.size());
    for (std::size_t t = 0; t < surface.size(); ++t) {
      const auto corners = surface[t];
      if (is_usable(corners)) area_ += length(area_normal(corners)) / 2;
      end_.push_back(area_);
    }
  }

  double area() const { return area_; }

  template <class F>
  void for_each(std::size_t n, F&& f) const {
    const double spacing = area_ / static_cast<double>(n);
    std::size_t t = 0;
    for (std::size_t k = 0; k < n; ++k) {
      const auto at = static_cast<double>(k) + 0.5;
      while (t + 1 < end_.size() && end_[t] <= at * spacing) ++t;
      f(point_at(t, at), spacing, t);
    }
  }

  /// Half of them by area, half of them alike in all triangles, at least one in each: small ones stick out, too. The
  /// sequence goes on from one to the next: in the equal triangles of a fan, the same few points would leave rings
  /// between them unseen.
  template <class F>
  void for_each_in_all(std::size_t n, F&& f) const {
    const double each = static_cast<double>(n) / static_cast<double>(2 * end_.size());
    double before = 0, k = 0.5;
    for (std::size_t t = 0; t < end_.size(); ++t) {
      const double area = end_[t] - before;
      before = end_[t];
      if (!(area > 0)) continue;
      const double some = std::max(1., std::round(each + static_cast<double>(n) * area / (2 * area_)));
      if (some > 1)
        for (const double end = k + some; k < end; ++k) f(point_at(t, k), area / some, t);
      else
        f(point_in_middle(t), area, t);
    }
  }

 private:
  Vec3 point_at(std::size_t t, double k) const {
    const auto [u, v] = spread_in_triangle(k);
    const auto c = surface_[t];
    return c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]);
  }
  Vec3 point_in_middle(std::size_t t) const {
    const auto c = surface_[t];
    return (1. / 3) * (c[0] + c[1] + c[2]);
  }

  const Triangles& surface_;
  std::vector<double> end_;
  double area_ = 0;
};

using Gram = std::array<double, 6>;

Gram gram_of(const std::array<Vec3, 3>& columns) {
  Gram out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = dot(columns[k], columns[k]);
    out[3 + k] = dot(columns[k], columns[(k + 1) % 3]);
  }
  return out;
}

Gram gram_of(const Matrix& m) { return gram_of({m.column(0), m.column(1), m.column(2)}); }

/// Of a map behind `m`.
Gram gram_after(const Matrix& m, const Gram& g) {
  const auto times = [&](const Vec3& v) {
    return Vec3{g[0] * v[0] + g[3] * v[1] + g[5] * v[2], g[3] * v[0] + g[1] * v[1] + g[4] * v[2],
                g[5] * v[0] + g[4] * v[1] + g[2] * v[2]};
  };
  Gram out;
  for (int k = 0; k < 3; ++k) {
    const Vec3 way = times(m.column(k));
    out[static_cast<std::size_t>(k)] = dot(m.column(k), way);
    out[static_cast<std::size_t>(3 + k)] = dot(m.column((k + 1) % 3), way);
  }
  return out;
}

/// The squared length of a way in the map, where `products` are those of the way.
double applied(const Gram& g, const Gram& products) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += g[k] * products[k] + 2 * g[3 + k] * products[3 + k];
  return sum;
}

/// No way becomes shorter in it (Gershgorin).
Gram without_products(const Gram& g) {
  Gram out{};
  for (std::size_t k = 0; k < 3; ++k) out[k] = g[k] + std::abs(g[3 + k]) + std::abs(g[3 + (k + 2) % 3]);
  return out;
}

/// Whether no way is longer in `a` than in `b`, as far as can be seen at once: it is the same map but for its size.
bool is_within(const Gram& a, const Gram& b) {
  constexpr double rounding = 1e-9;
  const double factor = (a[0] + a[1] + a[2]) / (b[0] + b[1] + b[2]);
  if (!(factor <= 1 + rounding)) return false;
  for (std::size_t k = 0; k < 6; ++k)
    if (std::abs(a[k] - factor * b[k]) > rounding * (a[0] + a[1] + a[2])) return false;
  return true;
}

}  // namespace

std::array<double, 2> spread_in_triangle(double k) {
  constexpr double step_u = 0.7548776662466927, step_v = 0.5698402909980532;
  const double u = fraction(k * step_u), v = fraction(k * step_v);
  if (u + v > 1) return {1 - u, 1 - v};
  return {u, v};
}

std::vector<SurfaceSample> sample_surface(const Triangles& surface, std::size_t n) {
  std::vector<SurfaceSample> out;
  const Spread spread(surface);
  if (!(spread.area() > 0) || n == 0) return out;
  std::vector<std::uint32_t> used(surface.corners.begin(), surface.corners.end());
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const std::size_t stride = (used.size() + n - 1) / n, n_corners = (used.size() + stride - 1) / stride;
  out.reserve(n + n_corners);
  const auto add = [&](const Vec3& p, double area, std::size_t t) {
    out.push_back({p, area * (1 - share_of_corners), unit(area_normal(surface[t]))});
  };
  if (surface.size() <= n)
    spread.for_each_in_all(n, add);
  else
    spread.for_each(n, add);
  const double rest = share_of_corners * spread.area() / static_cast<double>(n_corners);
  for (std::size_t i = 0; i < used.size(); i += stride) {
    const Vec3 p = surface.position(used[i]);
    if (is_usable({p, p, p})) out.push_back({p, rest});
  }
  return out;
}

void Distortion::add(const Vec3& way, double area) {
  const double squared = dot(way, way);
  squares += area * squared;
  for (std::size_t k = 0; k < 3; ++k) {
    products[k] += area * way[k] * way[k];
    products[3 + k] += area * way[k] * way[(k + 1) % 3];
  }
  if (squared <= max * max) return;
  max = std::sqrt(squared);
  farthest = way;
}

Stretch::Stretch(const Matrix& m, double area) : most_(gram_of(m)) {
  std::ranges::transform(most_, sum_.begin(), [&](double x) { return area * x; });
}

void Stretch::add(const Stretch& other) {
  for (std::size_t k = 0; k < 6; ++k) sum_[k] += other.sum_[k];
  if (is_within(other.most_, most_)) return;
  if (is_within(most_, other.most_)) {
    most_ = other.most_;
    return;
  }
  const auto a = without_products(most_), b = without_products(other.most_);
  std::ranges::transform(a, b, most_.begin(), [](double x, double y) { return std::max(x, y); });
}

Stretch Stretch::after(const Matrix& m, double area) const {
  Stretch out;
  out.sum_ = gram_after(m, sum_);
  out.most_ = gram_after(m, most_);
  for (auto& x : out.sum_) x *= area;
  return out;
}

double Stretch::squares(const Distortion& d) const { return std::max(applied(sum_, d.products), 0.); }

double Stretch::max(const Distortion& d) const {
  Distortion longest;
  longest.add(d.farthest, 1);
  return std::sqrt(std::max(applied(most_, longest.products), 0.));
}

void find_regions(const Original& original, std::span<SurfaceSample> samples) {
  auto guess = ClosestPoint::no_guess;
  for (auto& s : samples) {
    guess = original.nearest.nearest(s.point, s.normal, guess).triangle;
    if (guess == ClosestPoint::no_guess) continue;
    s.region = original.regions->label(guess);
    const double depth = original.regions->distance_of_others(s.point, s.region);
    s.squared_depth = depth * depth;
  }
}

void measure_edges(const std::array<Vec3, 3>& corners, std::uint32_t region, double spacing, const Original& original,
                   Distortion& out) {
  constexpr double most_of_edge = 16;
  auto guess = ClosestPoint::no_guess;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 way = corners[(k + 1) % 3] - corners[k];
    const int n = static_cast<int>(std::min(fast_length(way) / spacing, most_of_edge));
    for (int i = 0; i < n; ++i) {
      const Vec3 p = corners[k] + ((i + 0.5) / n) * way;
      const auto found = original.ask(p, region, guess);
      guess = found.triangle;
      if (found.distance > out.max && guess != ClosestPoint::no_guess) out.add(way_to(p, original.surface[guess]), 0);
    }
  }
}

Distortion measure_distortion(const Triangles& surface, const ClosestPoint& nearest_on_surface,
                              std::span<const SurfaceSample> samples, const Original& original,
                              std::span<const std::uint32_t> regions, std::size_t n) {
  Distortion out;
  auto guess = ClosestPoint::no_guess;
  for (const auto& s : samples) {
    const auto found = nearest_on_surface.nearest(s.point, {}, guess);
    guess = found.triangle;
    if (guess == ClosestPoint::no_guess) continue;
    out.add(way_to(s.point, surface[guess], s.enough), s.weight);
  }
  guess = ClosestPoint::no_guess;
  const Spread spread(surface);
  if (spread.area() > 0)
    spread.for_each(n, [&](const Vec3& p, double area, std::size_t face) {
      const auto found = original.ask(p, regions.empty() ? ClosestOfLabel::no_label : regions[face], guess);
      guess = found.triangle;
      if (guess != ClosestPoint::no_guess) out.add(way_to(p, original.surface[guess]), area);
    });
  return out;
}

}  // namespace wrlkit::simplify
