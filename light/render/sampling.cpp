#include "light/render/sampling.h"

#include <algorithm>

#include "base/parallel.h"

namespace wrlkit::drawing {
namespace {

constexpr double visible_step = 0.04;  // differences below need no more samples

struct Pixel {
  float mean[3], low[3], high[3];
};

class Sampler {
 public:
  Sampler(const Raster& raster, const std::function<V3(double, double)>& color)
      : raster_(raster), color_(color), pixels_(std::size_t(raster.width) * raster.height) {}

  Image run() {
    each_row([&](int y) {
      for (int x = 0; x < raster_.width; ++x) at(x, y) = first(x, y);
    });
    Image image{raster_.width, raster_.height, 3, std::vector<std::uint8_t>(pixels_.size() * 3)};
    each_row([&](int y) {
      for (int x = 0; x < raster_.width; ++x) put(image, x, y);
    });
    return image;
  }

 private:
  Pixel& at(int x, int y) { return pixels_[std::size_t(y) * raster_.width + x]; }

  template <class F>
  void each_row(F&& row) {
    parallel_for(static_cast<std::size_t>(raster_.height), [&](std::size_t y) { row(static_cast<int>(y)); });
  }

  /// Four samples that share neither a row nor a column of a 4 by 4 grid, so that thin things are met in any direction.
  Pixel first(int x, int y) const {
    constexpr double grid[4][2] = {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}};
    if (raster_.samples < 2) return statistics({color_(x + 0.5, y + 0.5)});
    return statistics({color_(x + grid[0][0], y + grid[0][1]), color_(x + grid[1][0], y + grid[1][1]),
                       color_(x + grid[2][0], y + grid[2][1]), color_(x + grid[3][0], y + grid[3][1])});
  }

  static Pixel statistics(std::initializer_list<V3> colors) {
    V3 sum, low(1), high(0);
    for (const V3& c : colors) {
      sum += c;
      low = min(low, c);
      high = max(high, c);
    }
    V3 mean = (1.0 / static_cast<double>(colors.size())) * sum;
    auto f = [](double v) { return static_cast<float>(v); };
    return {{f(mean.x), f(mean.y), f(mean.z)}, {f(low.x), f(low.y), f(low.z)}, {f(high.x), f(high.y), f(high.z)}};
  }

  bool has_detail(int x, int y) {
    float low[3] = {1, 1, 1}, high[3] = {};
    for (int v = std::max(0, y - 1); v <= std::min(raster_.height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(raster_.width - 1, x + 1); ++u)
        for (int c = 0; c < 3; ++c) {
          low[c] = std::min(low[c], at(u, v).low[c]);
          high[c] = std::max(high[c], at(u, v).high[c]);
        }
    return high[0] - low[0] > visible_step || high[1] - low[1] > visible_step || high[2] - low[2] > visible_step;
  }

  V3 refined(int x, int y) const {
    V3 sum;
    int n = raster_.samples;
    for (int v = 0; v < n; ++v)
      for (int u = 0; u < n; ++u) sum += color_(x + (u + 0.5) / n, y + (v + 0.5) / n);
    return (1.0 / (n * n)) * sum;
  }

  void put(Image& image, int x, int y) {
    const Pixel& p = at(x, y);
    V3 c = raster_.samples > 2 && has_detail(x, y) ? refined(x, y) : V3(p.mean[0], p.mean[1], p.mean[2]);
    auto* to = image.pixels.data() + (std::size_t(y) * raster_.width + x) * 3;
    for (double v : {c.x, c.y, c.z}) *to++ = static_cast<std::uint8_t>(std::clamp(v, 0.0, 1.0) * 255 + 0.5);
  }

  const Raster& raster_;
  const std::function<V3(double, double)>& color_;
  std::vector<Pixel> pixels_;
};

}  // namespace

Image sample_picture(const Raster& raster, const std::function<V3(double, double)>& color) {
  return Sampler(raster, color).run();
}

}  // namespace wrlkit::drawing
