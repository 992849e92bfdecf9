#include "passes/lightmap/fill.h"

#include <algorithm>

namespace wrlkit::bake {
namespace {

struct Layer {
  int width, height;
  std::vector<Rgb> texels;
  std::vector<char> known;

  std::size_t at(int x, int y) const { return std::size_t(std::min(y, height - 1)) * width + std::min(x, width - 1); }
};

/// Half as large; a texel is known when one of its four is.
Layer half(const Layer& from) {
  Layer to{(from.width + 1) / 2, (from.height + 1) / 2, {}, {}};
  to.texels.resize(std::size_t(to.width) * to.height);
  to.known.resize(to.texels.size());
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      Rgb sum;
      int n = 0;
      for (int k = 0; k < 4; ++k)
        if (std::size_t i = from.at(2 * x + k % 2, 2 * y + k / 2); from.known[i]) {
          sum += from.texels[i];
          ++n;
        }
      const std::size_t i = to.at(x, y);
      if (n) {
        to.texels[i] = (1.0f / static_cast<float>(n)) * sum;
        to.known[i] = 1;
      }
    }
  return to;
}

/// Calls f(j) for each texel of the same chart around texel i.
template <class F>
void each_neighbour(std::size_t i, std::span<const std::uint32_t> chart, int width, int height, F&& f) {
  const int x = static_cast<int>(i % width), y = static_cast<int>(i / width);
  for (int v = std::max(0, y - 1); v <= std::min(height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(width - 1, x + 1); ++u)
      if (const std::size_t j = std::size_t(v) * width + u; j != i && chart[j] == chart[i]) f(j);
}

}  // namespace

void fill_charts(std::span<std::vector<Rgb>> layers, std::vector<char>& known, std::span<const std::uint32_t> chart,
                 std::uint32_t no_chart, int width, int height) {
  enum : char { unknown, is_known, waits };
  std::vector<std::size_t> border, next;
  auto add_around = [&](std::size_t i) {
    each_neighbour(i, chart, width, height, [&](std::size_t j) {
      if (known[j] == unknown) {
        known[j] = waits;
        next.push_back(j);
      }
    });
  };
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] == is_known && chart[i] != no_chart) add_around(i);
  while (!next.empty()) {
    border.swap(next);
    next.clear();
    for (std::size_t i : border)
      for (auto& layer : layers) {
        Rgb sum;
        int n = 0;
        each_neighbour(i, chart, width, height, [&](std::size_t j) {
          if (known[j] == is_known) {
            sum += layer[j];
            ++n;
          }
        });
        layer[i] = (1.0f / static_cast<float>(n)) * sum;
      }
    for (std::size_t i : border) known[i] = is_known;
    for (std::size_t i : border) add_around(i);
  }
}

void fill(std::vector<Rgb>& texels, const std::vector<char>& known, int width, int height) {
  std::vector<Layer> layers{{width, height, std::move(texels), known}};
  while (layers.back().width > 1 || layers.back().height > 1) layers.push_back(half(layers.back()));
  for (std::size_t l = layers.size() - 1; l-- > 0;) {
    Layer& fine = layers[l];
    const Layer& coarse = layers[l + 1];
    for (int y = 0; y < fine.height; ++y)
      for (int x = 0; x < fine.width; ++x)
        if (std::size_t i = fine.at(x, y); !fine.known[i]) fine.texels[i] = coarse.texels[coarse.at(x / 2, y / 2)];
  }
  texels = std::move(layers[0].texels);
}

}  // namespace wrlkit::bake
