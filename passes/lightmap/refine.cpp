#include "passes/lightmap/refine.h"

#include <algorithm>
#include <cmath>

#include "passes/lightmap/denoise.h"

namespace wrlkit::bake {
namespace {

constexpr int side = 8;           // of a block, texels
constexpr double unseen = 1.5;    // errors are so many times as large: the filter prefers texels that err alike, and blurs
constexpr double settled = 0.25;  // of the error that is allowed: more rays for such a block would not be felt

struct Block {
  double error2 = 0, light = 0, n = 0;

  void add(const Block& b) { error2 += b.error2, light += b.light, n += b.n; }
};

}  // namespace

std::vector<char> unsettled(Page page, const std::vector<Rgb>& difference, double error, bool denoised) {
  page.layers.push_back(difference);
  if (denoised) denoise(page);
  const std::vector<Rgb>& off = page.layers.back();
  const int columns = (page.width + side - 1) / side, rows = (page.height + side - 1) / side;
  std::vector<Block> blocks(std::size_t(columns) * rows);
  for (std::size_t i = 0; i < page.size(); ++i) {
    if (!page.covered(i)) continue;
    const double e = luminance(off[i]);
    blocks[i / page.width / side * columns + i % page.width / side].add({e * e, luminance(page.light()[i]), 1});
  }
  Block all;
  for (const Block& b : blocks) all.add(b);
  const double allowed = error * all.light / (unseen * std::max(1.0, all.n));
  auto is_above = [](const Block& b, double e) { return b.error2 > e * e * b.n; };
  std::vector<char> out(page.size());
  if (!is_above(all, allowed)) return out;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      Block around;  // the two may agree by chance in one
      for (int v = std::max(0, y - 1); v <= std::min(rows - 1, y + 1); ++v)
        for (int u = std::max(0, x - 1); u <= std::min(columns - 1, x + 1); ++u) around.add(blocks[std::size_t(v) * columns + u]);
      if (!is_above(around, settled * allowed)) continue;
      for (int j = y * side; j < std::min(page.height, (y + 1) * side); ++j)
        for (int i = x * side; i < std::min(page.width, (x + 1) * side); ++i) out[page.at(i, j)] = page.covered(page.at(i, j));
    }
  return out;
}

}  // namespace wrlkit::bake
