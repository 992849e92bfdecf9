#include "passes/lightmap/denoise.h"

#include <algorithm>
#include <cmath>

#include "passes/parallel.h"

namespace wrlkit::bake {
namespace {

constexpr float spline[3] = {3.0f / 8, 1.0f / 4, 1.0f / 16};  // the B3 spline, from its middle

float power(float base, int doublings) {
  for (int i = 0; i < doublings; ++i) base *= base;
  return base;
}

class Filter {
 public:
  Filter(const Page& page, int step, float contrast) : page_(page), step_(step), contrast_(contrast) {}

  /// Weighted means around a texel, and the variance that is left of the light.
  void at(int x, int y, std::vector<std::vector<Rgb>>& layers, float& variance) const {
    const std::size_t i = page_.at(x, y);
    const float noise = contrast_ * std::sqrt(smooth_variance(x, y)) + 1e-6f;
    const float own = luminance(page_.light()[i]);
    for (auto& l : layers) l[i] = {};
    float weights = 0, noise_left = 0;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        const int u = x + dx * step_, v = y + dy * step_;
        if (u < 0 || v < 0 || u >= page_.width || v >= page_.height) continue;
        const std::size_t j = page_.at(u, v);
        float w = spline[std::abs(dx)] * spline[std::abs(dy)] * likeness(page_.places[i], page_.places[j]);
        if (!(w > 0)) continue;
        w *= std::exp(-std::fabs(luminance(page_.light()[j]) - own) / noise);
        for (std::size_t l = 0; l < layers.size(); ++l) layers[l][i] += w * page_.layers[l][j];
        weights += w;
        noise_left += w * w * page_.variance[j];
      }
    for (auto& l : layers) l[i] = (1 / weights) * l[i];
    variance = noise_left / (weights * weights);
  }

 private:
  /// 1 for neighbours on a plane, falling to 0 at creases and steps; 0 between charts.
  static float likeness(const Place& a, const Place& b) {
    if (a.chart != b.chart) return 0;
    const Vec d = b.position - a.position;
    const float height = std::fabs(dot(d, a.normal)), distance2 = dot(d, d);
    const float facing = std::max(0.0f, dot(a.normal, b.normal));
    const float slope = distance2 > 0 ? height * height / distance2 : 0;  // sine squared of the way out of the plane
    return power(facing, 5) * std::exp(-8 * slope);
  }

  /// The noise of one texel is itself a guess: the mean of its neighbours is a better one.
  float smooth_variance(int x, int y) const {
    const std::uint32_t chart = page_.places[page_.at(x, y)].chart;
    float sum = 0, weights = 0;
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int u = std::clamp(x + dx, 0, page_.width - 1), v = std::clamp(y + dy, 0, page_.height - 1);
        const std::size_t j = page_.at(u, v);
        if (page_.places[j].chart != chart) continue;
        const float w = (dx ? 0.25f : 0.5f) * (dy ? 0.25f : 0.5f);
        sum += w * page_.variance[j];
        weights += w;
      }
    return sum / weights;
  }

  const Page& page_;
  int step_;
  float contrast_;
};

}  // namespace

void denoise(Page& page, const DenoiseOptions& options) {
  auto layers = page.layers;
  std::vector<float> variance(page.size());
  for (int pass = 0; pass < options.passes; ++pass) {
    const Filter filter(page, 1 << pass, options.contrast);
    parallel_for(static_cast<std::size_t>(page.height), [&](std::size_t y) {
      for (int x = 0; x < page.width; ++x) {
        const std::size_t i = page.at(x, static_cast<int>(y));
        if (page.covered(i)) filter.at(x, static_cast<int>(y), layers, variance[i]);
      }
    });
    page.layers.swap(layers);
    page.variance.swap(variance);
  }
}

}  // namespace wrlkit::bake
