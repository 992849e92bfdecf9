#include "passes/lightmap/seams.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace wrlkit::bake {
namespace {

constexpr float unlike = 0.1f;    // difference that is a jump, relative to the brighter side
constexpr float unseen = 0.004f;  // in a display-referred picture less than 14 of 255, in the dark
constexpr float stay = 0.02f;     // what moving a texel costs, against a difference across the seam

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
  explicit System(std::span<Canvas> pages) : pages_(pages) {}

  void add(const Seam& s) {
    auto length = [](const SeamSide& e) { return std::hypot(e.end[1].x - e.end[0].x, e.end[1].y - e.end[0].y); };
    const int n = std::clamp(static_cast<int>(std::ceil(2 * std::max(length(s.a), length(s.b)))), 1, 1 << 16);
    for (int i = 0; i < n; ++i) {
      const float t = (i + 0.5f) / n;
      if (is_inside(s.a, t) || is_inside(s.b, t)) continue;
      agreements_.push_back({tap(s.a, t), tap(s.b, t)});
    }
  }

  /// Conjugate gradients on (A^T A + stay I) x = stay x0, from x0.
  void solve(int iterations) {
    std::vector<Rgb> x(texel_of_.size()), r(x.size()), p(x.size()), q(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = texel(i);
    apply(x, q);
    for (std::size_t i = 0; i < x.size(); ++i) p[i] = r[i] = stay * x[i] - q[i];
    double rr = dot(r, r);
    const double enough = 1e-10 * rr;
    for (int k = 0; k < iterations && rr > enough; ++k) {
      apply(p, q);
      const auto step = static_cast<float>(rr / dot(p, q));
      for (std::size_t i = 0; i < x.size(); ++i) {
        x[i] += step * p[i];
        r[i] = r[i] - step * q[i];
      }
      const double next = dot(r, r);
      const auto turn = static_cast<float>(next / rr);
      for (std::size_t i = 0; i < p.size(); ++i) p[i] = r[i] + turn * p[i];
      rr = next;
    }
    for (std::size_t i = 0; i < x.size(); ++i)
      texel(i) = {std::max(0.0f, x[i].r), std::max(0.0f, x[i].g), std::max(0.0f, x[i].b)};
  }

  SeamReport report() {
    SeamReport out{agreements_.size(), 0};
    auto shown = [this](const Tap& t) {
      Rgb sum;
      for (int k = 0; k < 4; ++k) sum += t.weight[k] * texel(t.unknown[k]);
      return luminance(sum);
    };
    for (const auto& e : agreements_) {
      const float a = shown(e.a), b = shown(e.b);
      out.jumps += std::fabs(a - b) > unlike * std::max(a, b) + unseen;
    }
    return out;
  }

 private:
  /// Calls f(k, texel, weight) for the four texels that a bilinear filter mixes at a place of a seam.
  template <class F>
  void each_tap(const SeamSide& e, float t, F&& f) const {
    const Canvas& page = pages_[e.page];
    const float x = e.end[0].x + t * (e.end[1].x - e.end[0].x) - 0.5f,
                y = e.end[0].y + t * (e.end[1].y - e.end[0].y) - 0.5f;
    const float fx = x - std::floor(x), fy = y - std::floor(y);
    for (int k = 0; k < 4; ++k) {
      const int u = std::clamp(static_cast<int>(std::floor(x)) + (k & 1), 0, page.width - 1);
      const int v = std::clamp(static_cast<int>(std::floor(y)) + (k >> 1), 0, page.height - 1);
      f(k, std::uint64_t(v) * page.width + u, (k & 1 ? fx : 1 - fx) * (k >> 1 ? fy : 1 - fy));
    }
  }

  /// Half or more of what is shown there.
  bool is_inside(const SeamSide& e, float t) const {
    const auto& inside = pages_[e.page].inside;
    if (inside.empty()) return false;
    float sum = 0;
    each_tap(e, t, [&](int, std::uint64_t texel, float weight) { sum += inside[texel] ? weight : 0; });
    return sum >= 0.5f;
  }

  Tap tap(const SeamSide& e, float t) {
    Tap out;
    each_tap(e, t, [&](int k, std::uint64_t texel, float weight) {
      out.unknown[k] = number_of(std::uint64_t{e.page} << 32 | texel);
      out.weight[k] = weight;
    });
    return out;
  }

  Rgb& texel(std::size_t unknown) { return pages_[texel_of_[unknown] >> 32].texels[texel_of_[unknown] & 0xffffffff]; }

  std::uint32_t number_of(std::uint64_t texel) {
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
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += double{a[i].r} * b[i].r + double{a[i].g} * b[i].g + double{a[i].b} * b[i].b;
    return sum;
  }

  std::span<Canvas> pages_;
  std::vector<Agreement> agreements_;
  std::unordered_map<std::uint64_t, std::uint32_t> numbers_;
  std::vector<std::uint64_t> texel_of_;  // by unknown: page, and place in it
};

}  // namespace

SeamReport close_seams(std::span<Canvas> pages, std::span<const Seam> seams, int iterations) {
  System system(pages);
  for (const Seam& s : seams) system.add(s);
  system.solve(iterations);
  return system.report();
}

}  // namespace wrlkit::bake
