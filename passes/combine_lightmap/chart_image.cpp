#include "passes/combine_lightmap/chart_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace wrlkit::combine {
namespace {

using unwrap::Point2;

/// As unwrap::pack counts them.
int texels(double length) { return std::max(1, static_cast<int>(std::ceil(length - 1e-3))); }

}  // namespace

ChartImage::ChartImage(Point2 size)
    : width_(texels(size.x)),
      height_(texels(size.y)),
      margin_{(width_ - size.x) / 2, (height_ - size.y) / 2},
      texels_(std::size_t(width_) * height_),
      covered_(texels_.size()) {}

Texel4 ChartImage::at(double x, double y) const {
  const double u = std::clamp(x - 0.5, 0.0, width_ - 1.0), v = std::clamp(y - 0.5, 0.0, height_ - 1.0);
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const int right = std::min(left + 1, width_ - 1), bottom = std::min(top + 1, height_ - 1);
  const double s = u - left, t = v - top;
  Texel4 out{};
  for (std::size_t c = 0; c < 4; ++c) {
    auto of = [&](int column, int row) { return double{1} * texels_[index(column, row)].rgba[c]; };
    const double above = of(left, top) * (1 - s) + of(right, top) * s;
    const double below = of(left, bottom) * (1 - s) + of(right, bottom) * s;
    out.rgba[c] = static_cast<std::uint8_t>(above * (1 - t) + below * t + 0.5);
  }
  return out;
}

void ChartImage::paint(std::span<const PageTriangle> triangles, std::span<const Painted> painted, bool alpha) {
  constexpr double slack = 1e-6;
  std::vector<char> touched(texels_.size());
  Page page(width_, height_, 1);
  page.paint(triangles, [&](std::size_t i, const std::array<double, 3>& weights, double x, double y) {
    const std::size_t texel = index(static_cast<int>(x), static_cast<int>(y));
    texels_[texel] = painted[i].color(weights, x, y, alpha);
    touched[texel] = 1;
    covered_[texel] = std::ranges::min(weights) >= -slack;
    return texels_[texel];
  });
  if (std::ranges::find(covered_, 1) == covered_.end()) covered_ = std::move(touched);
}

/// Texels next to covered ones, which filters mix in, go on as these; those further away are the mean of all.
void ChartImage::extend() {
  constexpr int rings = 3;
  std::array<std::uint64_t, 4> sum{};
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    if (!covered_[i]) continue;
    for (std::size_t c = 0; c < 4; ++c) sum[c] += texels_[i].rgba[c];
    ++n;
  }
  Texel4 mean{{0, 0, 0, 255}};
  for (std::size_t c = 0; c < 4 && n; ++c) mean.rgba[c] = static_cast<std::uint8_t>((sum[c] + n / 2) / n);
  std::vector<char> known = covered_;
  for (int ring = 0; ring < rings; ++ring) {
    const auto before = known;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        if (before[index(x, y)]) continue;
        std::array<int, 4> around{};
        int m = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height_ - 1); ++v)
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width_ - 1); ++u) {
            if (!before[index(u, v)]) continue;
            for (std::size_t c = 0; c < 4; ++c) around[c] += texels_[index(u, v)].rgba[c];
            ++m;
          }
        if (!m) continue;
        known[index(x, y)] = 1;
        for (std::size_t c = 0; c < 4; ++c)
          texels_[index(x, y)].rgba[c] = static_cast<std::uint8_t>((around[c] + m / 2) / m);
      }
  }
  for (std::size_t i = 0; i < texels_.size(); ++i)
    if (!known[i]) texels_[i] = mean;
}

ChartImage ChartImage::shrunk(Point2 size, double scale) const {
  ChartImage out({size.x * scale, size.y * scale});
  std::vector<std::array<std::uint32_t, 4>> sum(out.texels_.size());
  std::vector<std::uint32_t> n(out.texels_.size());
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      if (!covered_[index(x, y)]) continue;
      const int u = static_cast<int>((x + 0.5 - margin_.x) * scale + out.margin_.x),
                v = static_cast<int>((y + 0.5 - margin_.y) * scale + out.margin_.y);
      const auto to = out.index(std::clamp(u, 0, out.width_ - 1), std::clamp(v, 0, out.height_ - 1));
      for (std::size_t c = 0; c < 4; ++c) sum[to][c] += texels_[index(x, y)].rgba[c];
      ++n[to];
    }
  for (std::size_t i = 0; i < n.size(); ++i) {
    out.covered_[i] = n[i] > 0;
    for (std::size_t c = 0; c < 4 && n[i]; ++c)
      out.texels_[i].rgba[c] = static_cast<std::uint8_t>((sum[i][c] + n[i] / 2) / n[i]);
  }
  out.extend();
  return out;
}

Difference ChartImage::difference(const ChartImage& shrunk, double scale) const {
  constexpr std::uint64_t rare = 100;
  constexpr double enough = 1 << 16;  // texels that are looked at
  const int step = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(texels_.size()) / enough)));
  std::array<std::uint64_t, 256> count{};
  std::uint64_t n = 0;
  double square = 0;
  for (int y = 0; y < height_; y += step)
    for (int x = y / step % step; x < width_; x += step) {
      if (!covered_[index(x, y)]) continue;
      const Texel4 mine = texels_[index(x, y)], other = shrunk.at((x + 0.5 - margin_.x) * scale + shrunk.margin_.x,
                                                                  (y + 0.5 - margin_.y) * scale + shrunk.margin_.y);
      for (std::size_t c = 0; c < 4; ++c) {
        const int apart = std::abs(int{mine.rgba[c]} - int{other.rgba[c]});
        ++count[static_cast<std::size_t>(apart)];
        square += double(apart) * apart;
        ++n;
      }
    }
  if (!n) return {};
  std::size_t most = 255;
  for (std::uint64_t beyond = count[most]; most > 0 && beyond * rare <= n; beyond += count[most]) --most;
  return {std::sqrt(square / static_cast<double>(n)), static_cast<double>(most)};
}

}  // namespace wrlkit::combine
