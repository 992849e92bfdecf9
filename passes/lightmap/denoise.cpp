#include "passes/lightmap/denoise.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace wrlkit::bake {
namespace {

constexpr float nothing = 1e-6f;  // of noise. Numbers so small that some threads take them for 0 are far below
/// Few rays to lamps may all miss what stands between, and tell of no noise. So much of the variance of the rest is
/// believed of them, too.
constexpr float untold = 0.25f;
constexpr float spline[3] = {3.0f / 8, 1.0f / 4, 1.0f / 16};  // the B3 spline, from its middle

float power(float base, int doublings) {
  for (int i = 0; i < doublings; ++i) base *= base;
  return base;
}

/// 1 for neighbours on a plane, falling to 0 at creases and steps; 0 between charts.
float likeness(const TexelPlace& a, const TexelPlace& b) {
  if (a.chart != b.chart) return 0;
  const Vec d = b.position - a.position;
  const float height = std::fabs(dot(d, a.normal)), distance2 = dot(d, d);
  const float facing = std::max(0.0f, dot(a.normal, b.normal));
  const float slope = distance2 > 0 ? height * height / distance2 : 0;  // sine squared of the way out of the plane
  return power(facing, 5) * std::exp(-8 * slope);
}

/// Of a texel, or the mean of several.
struct LightAndNoise {
  float light = 0, noise = 0;
};

/// Means over a texel and the eight around it that are `step` away, as far as they lie in one plane.
std::vector<LightAndNoise> means(const Page& page, const std::vector<LightAndNoise>& of, int step) {
  std::vector<LightAndNoise> out(page.size());
  parallel_for(static_cast<std::size_t>(page.height), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < page.width; ++x) {
      const std::size_t i = page.at(x, y);
      if (!page.covered(i)) continue;
      float light = 0, noise = 0, weights = 0;
      for (int dy = -step; dy <= step; dy += step)
        for (int dx = -step; dx <= step; dx += step) {
          const int u = std::clamp(x + dx, 0, page.width - 1), v = std::clamp(y + dy, 0, page.height - 1);
          const std::size_t j = page.at(u, v);
          const float w = (dx ? 0.25f : 0.5f) * (dy ? 0.25f : 0.5f) * likeness(page.places[i], page.places[j]);
          light += w * of[j].light;
          noise += w * of[j].noise;
          weights += w;
        }
      out[i] = {light / weights, noise / weights};
    }
  });
  return out;
}

/// What tells noise from light: luminance and the standard deviation of it, over the texels around, as those of one
/// texel are guesses.
std::vector<LightAndNoise> guide(const Page& page, const Estimate& estimate) {
  std::vector<LightAndNoise> own(page.size());
  for (std::size_t i = 0; i < page.size(); ++i) own[i] = {luminance(estimate.light()[i]), estimate.variance[i]};
  own = means(page, own, 1);
  for (LightAndNoise& p : own) p.noise = std::sqrt(p.noise);
  return own;
}

class Filter {
 public:
  Filter(const Page& page, const Estimate& estimate, int step, float contrast)
      : page_(page), estimate_(estimate), guide_(guide(page, estimate)), step_(step), contrast_(contrast) {}

  /// Weighted means around a texel, and the variance that is left of the light.
  void at(int x, int y, std::vector<std::vector<Rgb>>& layers, float& variance) const {
    const std::size_t i = page_.at(x, y);
    if (!(guide_[i].noise > nothing)) return keep(i, layers, variance);
    const float noise = contrast_ * guide_[i].noise;
    const float own = guide_[i].light;
    for (auto& l : layers) l[i] = {};
    float weights = 0, noise_left = 0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        const int u = x + dx * step_, v = y + dy * step_;
        if (u < 0 || v < 0 || u >= page_.width || v >= page_.height) continue;
        const std::size_t j = page_.at(u, v);
        float w = spline[std::abs(dx)] * spline[std::abs(dy)] * likeness(page_.places[i], page_.places[j]);
        if (!(w > 0)) continue;
        w *= std::exp(-std::fabs(guide_[j].light - own) / noise);
        for (std::size_t l = 0; l < layers.size(); ++l) layers[l][i] += w * estimate_.layers[l][j];
        weights += w;
        noise_left += w * w * estimate_.variance[j];
      }
    for (auto& l : layers) l[i] = (1 / weights) * l[i];
    variance = noise_left / (weights * weights);
  }

 private:
  void keep(std::size_t i, std::vector<std::vector<Rgb>>& layers, float& variance) const {
    for (std::size_t l = 0; l < layers.size(); ++l) layers[l][i] = estimate_.layers[l][i];
    variance = estimate_.variance[i];
  }

  const Page& page_;
  const Estimate& estimate_;
  std::vector<LightAndNoise> guide_;
  int step_;
  float contrast_;
};

/// What was taken out is noise, or light that changes from texel to texel, such as the edge of a shadow. Noise is as
/// much as the variance says, and the share that is more than that comes back (the filter of Wiener).
void give_back(const Page& page, const Estimate& noisy, Estimate& filtered) {
  std::vector<LightAndNoise> taken(page.size());
  for (std::size_t i = 0; i < page.size(); ++i) {
    const float d = luminance(noisy.light()[i]) - luminance(filtered.light()[i]);
    taken[i] = {d * d, noisy.variance[i]};
  }
  for (int step : {1, 2, 4}) taken = means(page, taken, step);
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (!(taken[i].light > std::max(taken[i].noise, nothing * nothing))) continue;
    const float back = 1 - taken[i].noise / taken[i].light;
    for (std::size_t l = 0; l < filtered.layers.size(); ++l)
      filtered.layers[l][i] = (1 - back) * filtered.layers[l][i] + back * noisy.layers[l][i];
  }
}

}  // namespace

void denoise(const Page& page, Estimate& estimate, const DenoiseOptions& options) {
  const Estimate noisy = estimate;
  auto layers = estimate.layers;
  std::vector<float> variance(page.size());
  for (int pass = 0; pass < options.passes; ++pass) {
    const Filter filter(page, estimate, 1 << pass, options.contrast);
    parallel_for(static_cast<std::size_t>(page.height), [&](std::size_t y) {
      for (int x = 0; x < page.width; ++x) {
        const std::size_t i = page.at(x, static_cast<int>(y));
        if (page.covered(i)) filter.at(x, static_cast<int>(y), layers, variance[i]);
      }
    });
    estimate.layers.swap(layers);
    estimate.variance.swap(variance);
  }
  give_back(page, noisy, estimate);
}

std::vector<Rgb> shown_light(const Page& page, Estimate direct, Estimate gathered, bool denoised) {
  if (denoised) {
    for (std::size_t i = 0; i < page.size(); ++i) direct.variance[i] += untold * gathered.variance[i];
    denoise(page, direct);
    denoise(page, gathered);
  }
  for (std::size_t i = 0; i < page.size(); ++i) direct.light()[i] += gathered.light()[i];
  return std::move(direct.light());
}

}  // namespace wrlkit::bake
