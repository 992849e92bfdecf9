#include "passes/lightmap/refine.h"

#include <algorithm>
#include <cmath>

#include "passes/lightmap/denoise.h"

namespace wrlkit::bake {
namespace {

constexpr int side = 8;           // of a block, texels
constexpr double settled = 0.25;  // of the error that is allowed: more rays for such a block would not be felt

/// By one half of the rays: `sign` is 1 or -1.
Estimate half(Estimate whole, const std::vector<Rgb>& difference, float sign) {
  for (std::size_t i = 0; i < difference.size(); ++i) {
    whole.light()[i] += sign * difference[i];
    whole.variance[i] *= 2;
  }
  return whole;
}

/// Squared errors of some texels.
struct Errors {
  double sum = 0, squares = 0, light = 0, n = 0;

  void add(double error2, double l) {
    sum += error2;
    squares += error2 * error2;
    light += l;
    n += 1;
  }
  void add(const Errors& e) {
    sum += e.sum;
    squares += e.squares;
    light += e.light;
    n += e.n;
  }
  double mean() const { return sum / std::max(1.0, n); }
  double at_most() const { return (sum + std::sqrt(squares)) / std::max(1.0, n); }
};

}  // namespace

std::vector<char> unsettled(const Page& page, const PageLight& light, const Halves& halves, double error,
                            bool denoised) {
  auto filtered = [&](float sign) {
    return shown_light(page, half(light.direct, halves.direct, sign), half(light.gathered, halves.gathered, sign),
                       denoised);
  };
  const auto a = filtered(1), b = filtered(-1);
  const int columns = (page.width + side - 1) / side, rows = (page.height + side - 1) / side;
  std::vector<Errors> blocks(std::size_t(columns) * rows);
  auto square = [](const Rgb& c) { return double{luminance(c)} * luminance(c); };
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (!page.covered(i)) continue;
    const Rgb all = light.at(i), d = halves.direct[i] + halves.gathered[i];
    const double of_halves = 0.5 * (square(a[i] - (all - d)) + square(b[i] - (all + d))) - 2 * square(d);
    blocks[i / page.width / side * columns + i % page.width / side].add(0.5 * of_halves, luminance(all));
  }
  Errors all;
  for (const Errors& e : blocks) all.add(e);
  const double allowed = error * all.light / std::max(1.0, all.n);
  std::vector<char> out(page.size());
  if (!(all.at_most() > allowed * allowed)) return out;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      Errors around;  // of one, chance says too much
      for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(columns - 1, x + 1); ++u)
          around.add(blocks[std::size_t(v) * columns + u]);
      if (!(around.mean() > settled * settled * allowed * allowed)) continue;
      for (int j = y * side; j < std::min(page.height, (y + 1) * side); ++j)
        for (int i = x * side; i < std::min(page.width, (x + 1) * side); ++i)
          out[page.at(i, j)] = page.covered(page.at(i, j));
    }
  return out;
}

}  // namespace wrlkit::bake
