#include "passes/combine/page.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "passes/parallel.h"

namespace wrlkit::combine {
namespace {

constexpr std::uint8_t nobody = 255;
constexpr int rows_of_band = 64;

/// The columns of a triangle between two heights.
std::array<double, 2> columns(const PageTriangle& t, double top, double bottom) {
  double left = HUGE_VAL, right = -HUGE_VAL;
  for (int i = 0; i < 3; ++i) {
    int k = (i + 1) % 3;
    double x0 = t.x[i], y0 = t.y[i], x1 = t.x[k], y1 = t.y[k];
    if (y0 > y1) std::swap(x0, x1), std::swap(y0, y1);
    if (y1 < top || y0 > bottom) continue;
    for (double y : {std::max(top, y0), std::min(bottom, y1)}) {
      double x = y1 > y0 ? x0 + (x1 - x0) * (y - y0) / (y1 - y0) : x0;
      left = std::min(left, x), right = std::max(right, x);
    }
    if (y1 == y0) left = std::min(left, x1), right = std::max(right, x1);
  }
  return {left, right};
}

/// The nearest point of an edge, as a share of it, and its distance.
std::array<double, 2> nearest_on_edge(const PageTriangle& t, int i, double x, double y) {
  int k = (i + 1) % 3;
  double ex = t.x[k] - t.x[i], ey = t.y[k] - t.y[i], square = ex * ex + ey * ey;
  double at = square > 0 ? std::clamp(((x - t.x[i]) * ex + (y - t.y[i]) * ey) / square, 0.0, 1.0) : 0;
  return {at, std::hypot(x - t.x[i] - at * ex, y - t.y[i] - at * ey)};
}

/// Weights of the corners and the distance of a place. Weights go on outside, but not far: a sliver has no direction.
struct Position {
  std::array<double, 3> weights;
  double distance;
};

Position position(const PageTriangle& t, double area, double x, double y) {
  constexpr double far = 1;
  double b = ((x - t.x[0]) * (t.y[2] - t.y[0]) - (t.x[2] - t.x[0]) * (y - t.y[0])) / area;
  double c = ((t.x[1] - t.x[0]) * (y - t.y[0]) - (x - t.x[0]) * (t.y[1] - t.y[0])) / area;
  Position p{{1 - b - c, b, c}, 0};
  auto [low, high] = std::ranges::minmax(p.weights);
  if (low >= 0) return p;
  p.distance = HUGE_VAL;
  std::array<double, 3> on_edge{};
  for (int i = 0; i < 3; ++i) {
    auto [at, distance] = nearest_on_edge(t, i, x, y);
    if (distance >= p.distance) continue;
    p.distance = distance;
    on_edge = {};
    on_edge[i] = 1 - at, on_edge[(i + 1) % 3] = at;
  }
  if (low < -far || high > 1 + far) p.weights = on_edge;
  return p;
}

}  // namespace

Page::Page(int width, int height, double reach)
    : width_(width), height_(height), reach_(reach), texels_(std::size_t(width) * height), distance_(texels_.size(), nobody) {}

bool Page::paint(std::span<const PageTriangle> triangles, const Paint& paint) {
  std::atomic<bool> whole = true;
  const auto n_bands = static_cast<std::size_t>((height_ + rows_of_band - 1) / rows_of_band);
  parallel_for(n_bands, [&](std::size_t i) {
    Band band{static_cast<int>(i) * rows_of_band, std::min(height_, (static_cast<int>(i) + 1) * rows_of_band), 0};
    band.budget = most_layers * (static_cast<std::uint64_t>(band.end - band.begin) * width_ + triangles.size());
    if (!paint_band(triangles, paint, band)) whole = false;
  });
  return whole;
}

bool Page::paint_band(std::span<const PageTriangle> triangles, const Paint& paint, Band band) {
  for (std::size_t i = 0; i < triangles.size() && band.budget > 0; ++i) {
    const auto& t = triangles[i];
    auto [top, bottom] = std::ranges::minmax(t.y);
    if (bottom + reach_ < band.begin || top - reach_ > band.end) continue;
    if (std::abs(t.area()) > 0) paint_triangle(t, i, paint, band);
  }
  return band.budget > 0;
}

void Page::paint_triangle(const PageTriangle& t, std::size_t number, const Paint& paint, Band& band) {
  const double area = t.area();
  auto [top, bottom] = std::ranges::minmax(t.y);
  auto row = [&](double y) { return static_cast<int>(std::clamp(y, double(band.begin), double(band.end))); };
  for (int y = row(top - reach_); y < row(bottom + reach_ + 1) && band.budget > 0; ++y) {
    auto [left, right] = columns(t, y + 0.5 - reach_, y + 0.5 + reach_);
    int begin = static_cast<int>(std::clamp(left - reach_, 0.0, double(width_))), end = static_cast<int>(std::clamp(right + reach_ + 1, 0.0, double(width_)));
    band.budget -= std::min<std::uint64_t>(band.budget, static_cast<std::uint64_t>(std::max(end - begin, 1)));
    for (int x = begin; x < end; ++x) {
      const std::size_t at = std::size_t(y) * width_ + x;
      if (distance_[at] == 0) continue;
      auto p = position(t, area, x + 0.5, y + 0.5);
      if (!(p.distance < reach_)) continue;
      auto distance = static_cast<std::uint8_t>(p.distance > 0 ? 1 + p.distance / reach_ * (nobody - 2) : 0);
      if (distance >= distance_[at]) continue;
      distance_[at] = distance;
      texels_[at] = paint(number, p.weights, x + 0.5, y + 0.5);
    }
  }
}

Image Page::image(int channels) const {
  std::array<std::uint64_t, 3> sum{};
  std::uint64_t n = 0;
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    if (distance_[i] == nobody) continue;
    for (std::size_t c = 0; c < 3; ++c) sum[c] += texels_[i].rgba[c];
    ++n;
  }
  Texel4 mean{{0, 0, 0, 255}};
  for (std::size_t c = 0; c < 3 && n; ++c) mean.rgba[c] = static_cast<std::uint8_t>(sum[c] / n);
  Image out{width_, height_, channels, {}};
  out.pixels.reserve(texels_.size() * channels);
  for (std::size_t i = 0; i < texels_.size(); ++i) {
    const auto& from = distance_[i] == nobody ? mean : texels_[i];
    out.pixels.insert(out.pixels.end(), from.rgba.begin(), from.rgba.begin() + channels);
  }
  return out;
}

}  // namespace wrlkit::combine
