#include "light/links.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace wrlkit::light {
namespace {

using Lights = std::vector<V3>;

constexpr std::size_t cells_a_block = 1024;  // cells that are done in one piece
constexpr int most_steps = 100, most_reflections_followed = 20;
constexpr double most_growth = 1000;     // by reflections
constexpr double least_residual = 1e-4;  // of what is left over, to what does not depend on other cells

template <class F>
void each_cell(std::size_t n, F&& f) {
  parallel_for((n + cells_a_block - 1) / cells_a_block, [&](std::size_t b) {
    for (std::size_t i = b * cells_a_block; i < std::min(n, (b + 1) * cells_a_block); ++i) f(i);
  });
}

/// By channel; 0 where there is nothing to divide by.
V3 quotient(const V3& a, const V3& b) {
  const auto of = [](double x, double y) { return y != 0 ? x / y : 0; };
  return {of(a.x, b.x), of(a.y, b.y), of(a.z, b.z)};
}

V3 products(const Lights& a, const Lights& b) {
  V3 sum;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

class LinkSolver {
 public:
  explicit LinkSolver(std::span<const LinkedCell> cells) : cells_(cells) {
    for (const auto& c : cells) first_.push_back(c.first);
  }

  Lights run() const {
    Lights light = stabilised();
    if (!is_light(light)) {
      light = first_;
      for (int i = 0; i < most_reflections_followed; ++i) light = gathered(light);
    }
    for (V3& v : light) v = max(v, V3{});
    return light;
  }

 private:
  Lights gathered(const Lights& light) const {
    Lights out(light.size());
    each_cell(light.size(), [&](std::size_t c) {
      out[c] = first_[c];
      for (const Link& l : cells_[c].links) out[c] += V3(l.share[0], l.share[1], l.share[2]) * light[l.from];
    });
    return out;
  }

  /// The matrix of the system: what is left of light when what is reflected of it is taken away.
  Lights lacking(const Lights& light) const {
    Lights out = gathered(light);
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = light[c] - (out[c] - first_[c]);
    return out;
  }

  Lights stabilised() const {
    const std::size_t n = first_.size();
    Lights x = first_, r = lacking(x);
    for (std::size_t i = 0; i < n; ++i) r[i] = first_[i] - r[i];
    const Lights shadow = r;
    Lights p(n), v(n), s(n);
    V3 rho(1), alpha(1), omega(1);
    const V3 enough = least_residual * least_residual * products(first_, first_);
    for (int step = 0; step < most_steps && !is_within(products(r, r), enough); ++step) {
      const V3 rho_before = rho;
      rho = products(shadow, r);
      const V3 beta = quotient(rho, rho_before) * quotient(alpha, omega);
      for (std::size_t i = 0; i < n; ++i) p[i] = r[i] + beta * (p[i] - omega * v[i]);
      v = lacking(p);
      alpha = quotient(rho, products(shadow, v));
      for (std::size_t i = 0; i < n; ++i) s[i] = r[i] - alpha * v[i];
      const Lights t = lacking(s);
      omega = quotient(products(t, s), products(t, t));
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += alpha * p[i] + omega * s[i];
        r[i] = s[i] - omega * t[i];
      }
    }
    return x;
  }

  static bool is_within(const V3& a, const V3& most) { return a.x <= most.x && a.y <= most.y && a.z <= most.z; }

  /// Whether it is what the cells gather of it, and light: bounded, and not below zero but for rounding.
  bool is_light(const Lights& light) const {
    const Lights again = gathered(light);
    V3 off, all;
    double least = 0, most = 0, most_first = 0;
    for (std::size_t c = 0; c < light.size(); ++c) {
      most = std::max({most, light[c].x, light[c].y, light[c].z});
      most_first = std::max({most_first, first_[c].x, first_[c].y, first_[c].z});
      const V3 d = again[c] - light[c];
      off += d * d;
      all += light[c] * light[c];
      least = std::min({least, light[c].x, light[c].y, light[c].z});
    }
    constexpr double at_most = 1e-2;
    const double mean_square = mean(all) / static_cast<double>(std::max<std::size_t>(1, light.size()));
    if (!(most <= most_growth * most_first)) return false;
    return std::isfinite(mean(all)) && is_within(off, at_most * at_most * all) &&
           least * least <= at_most * mean_square;
  }

  std::span<const LinkedCell> cells_;
  Lights first_;
};

}  // namespace

void LinkedCell::link(std::uint32_t from, const V3& share) {
  links.push_back({from, {static_cast<float>(share.x), static_cast<float>(share.y), static_cast<float>(share.z)}});
}

void LinkedCell::merge() {
  std::ranges::stable_sort(links, {}, &Link::from);
  std::vector<Link> merged;
  for (const Link& l : links) {
    if (merged.empty() || merged.back().from != l.from)
      merged.push_back(l);
    else
      for (int k = 0; k < 3; ++k) merged.back().share[k] += l.share[k];
  }
  links = std::vector<Link>(merged.begin(), merged.end());  // no larger than it has to be: there are very many cells
}

std::vector<V3> solve(std::span<const LinkedCell> cells) { return LinkSolver(cells).run(); }

}  // namespace wrlkit::light
