#include "passes/lightmap/seams.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace wrlkit::bake {
namespace {

constexpr float stay = 0.1f;  // what moving a texel costs, against a difference across the seam

/// What a bilinear filter shows at a place: four texels and their weights.
struct Tap {
  std::uint32_t unknown[4];
  float weight[4];
};

/// One point of a seam: both taps shall show the same.
struct Agreement {
  Tap a, b;
};

class System {
 public:
  System(std::vector<Rgb>& texels, int width, int height) : texels_(texels), width_(width), height_(height) {}

  void add(const Seam& s) {
    auto length = [](const Spot2 e[2]) { return std::hypot(e[1].x - e[0].x, e[1].y - e[0].y); };
    const int n = std::clamp(static_cast<int>(std::ceil(2 * std::max(length(s.a), length(s.b)))), 1, 1 << 16);
    for (int i = 0; i < n; ++i) {
      const float t = (i + 0.5f) / n;
      agreements_.push_back({tap(s.a, t), tap(s.b, t)});
    }
  }

  /// Conjugate gradients on (A^T A + stay I) x = stay x0, from x0.
  void solve(int iterations) {
    std::vector<Rgb> x(texel_of_.size()), r(x.size()), p(x.size()), q(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = texels_[texel_of_[i]];
    apply(x, q);
    for (std::size_t i = 0; i < x.size(); ++i) p[i] = r[i] = stay * x[i] - q[i];
    double rr = dot(r, r);
    const double enough = 1e-10 * rr;
    for (int k = 0; k < iterations && rr > enough; ++k) {
      apply(p, q);
      const auto step = static_cast<float>(rr / dot(p, q));
      for (std::size_t i = 0; i < x.size(); ++i) x[i] += step * p[i], r[i] = r[i] - step * q[i];
      const double next = dot(r, r);
      const auto turn = static_cast<float>(next / rr);
      for (std::size_t i = 0; i < p.size(); ++i) p[i] = r[i] + turn * p[i];
      rr = next;
    }
    for (std::size_t i = 0; i < x.size(); ++i) texels_[texel_of_[i]] = {std::max(0.0f, x[i].r), std::max(0.0f, x[i].g), std::max(0.0f, x[i].b)};
  }

 private:
  Tap tap(const Spot2 e[2], float t) {
    const float x = e[0].x + t * (e[1].x - e[0].x) - 0.5f, y = e[0].y + t * (e[1].y - e[0].y) - 0.5f;
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    Tap out;
    for (int k = 0; k < 4; ++k) {
      const int u = std::clamp(static_cast<int>(std::floor(x)) + (k & 1), 0, width_ - 1), v = std::clamp(static_cast<int>(std::floor(y)) + (k >> 1), 0, height_ - 1);
      out.unknown[k] = number_of(std::size_t(v) * width_ + u);
      out.weight[k] = (k & 1 ? fx : 1 - fx) * (k >> 1 ? fy : 1 - fy);
    }
    return out;
  }

  std::uint32_t number_of(std::size_t texel) {
    auto [at, added] = numbers_.try_emplace(texel, static_cast<std::uint32_t>(texel_of_.size()));
    if (added) texel_of_.push_back(texel);
    return at->second;
  }

  static Rgb shown(const Tap& t, const std::vector<Rgb>& x) {
    Rgb sum;
    for (int k = 0; k < 4; ++k) sum += t.weight[k] * x[t.unknown[k]];
    return sum;
  }

  void apply(const std::vector<Rgb>& x, std::vector<Rgb>& to) const {
    for (std::size_t i = 0; i < x.size(); ++i) to[i] = stay * x[i];
    for (const auto& e : agreements_) {
      const Rgb difference = shown(e.a, x) - shown(e.b, x);
      for (int k = 0; k < 4; ++k) {
        to[e.a.unknown[k]] += e.a.weight[k] * difference;
        to[e.b.unknown[k]] += -e.b.weight[k] * difference;
      }
    }
  }

  static double dot(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += double{a[i].r} * b[i].r + double{a[i].g} * b[i].g + double{a[i].b} * b[i].b;
    return sum;
  }

  std::vector<Rgb>& texels_;
  int width_, height_;
  std::vector<Agreement> agreements_;
  std::unordered_map<std::size_t, std::uint32_t> numbers_;
  std::vector<std::size_t> texel_of_;
};

}  // namespace

void close_seams(std::vector<Rgb>& texels, int width, int height, std::span<const Seam> seams, int iterations) {
  System system(texels, width, height);
  for (const Seam& s : seams) system.add(s);
  system.solve(iterations);
}

}  // namespace wrlkit::bake
