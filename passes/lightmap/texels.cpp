#include "passes/lightmap/texels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wrlkit::bake {
namespace {

struct Weights {
  float w[3];
};

float area2(const Spot2& a, const Spot2& b, const Spot2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Negative ones where there is no area: no point lies in it.
Weights weights_at(const PlacedTriangle& t, const Spot2& p) {
  const auto& c = t.corner;
  float whole = area2(c[0], c[1], c[2]);
  if (!(std::abs(whole) > 0)) return {{-1, -1, -1}};
  float a = area2(p, c[1], c[2]) / whole, b = area2(p, c[2], c[0]) / whole;
  return {{a, b, 1 - a - b}};
}

bool inside(const Weights& w) { return w.w[0] >= 0 && w.w[1] >= 0 && w.w[2] >= 0; }

struct OnEdge {
  float distance2;
  Weights weights;
};

/// A little off the border, towards the middle: a point in the corner of two walls lies in both of them, and sees what
/// is behind one or the other.
Weights pulled_in(const PlacedTriangle& t, const Spot2& p, Weights w) {
  constexpr float way = 0.25f;  // texels
  const auto& c = t.corner;
  const float to_middle = std::hypot((c[0].x + c[1].x + c[2].x) / 3 - p.x, (c[0].y + c[1].y + c[2].y) / 3 - p.y);
  const float part = std::min(0.5f, way / std::max(to_middle, way));
  for (float& v : w.w) v = (1 - part) * v + part / 3;
  return w;
}

/// The nearest point of the border of a triangle.
OnEdge nearest_on_border(const PlacedTriangle& t, const Spot2& p) {
  OnEdge best{std::numeric_limits<float>::infinity(), {{1, 0, 0}}};
  for (int i = 0; i < 3; ++i) {
    int j = (i + 1) % 3;
    const Spot2 &a = t.corner[i], &b = t.corner[j];
    float dx = b.x - a.x, dy = b.y - a.y, length2 = dx * dx + dy * dy;
    float s = length2 > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / length2, 0.0f, 1.0f) : 0;
    float x = a.x + s * dx - p.x, y = a.y + s * dy - p.y;
    if (float d = x * x + y * y; d < best.distance2) {
      best = {d, {{0, 0, 0}}};
      best.weights.w[i] = 1 - s;
      best.weights.w[j] = s;
    }
  }
  return best;
}

struct Bounds {
  int x0, y0, x1, y1;  // texels whose filter may reach the triangle; the end is beyond the last
};

/// A bilinear filter at a point mixes texels whose centres are less than one texel away.
Bounds bounds_of(const PlacedTriangle& t, int width, int height) {
  auto [x0, x1] = std::minmax({t.corner[0].x, t.corner[1].x, t.corner[2].x});
  auto [y0, y1] = std::minmax({t.corner[0].y, t.corner[1].y, t.corner[2].y});
  auto cell = [](float v, int n) { return static_cast<int>(std::clamp(std::floor(v), 0.0f, static_cast<float>(n))); };
  return {cell(x0 - 0.5f, width), cell(y0 - 0.5f, height), cell(x1 + 1.5f, width), cell(y1 + 1.5f, height)};
}

/// A point of the grid within a texel; the first few by rank are spread over the texel (Roberts' R2 lattice).
struct RankedSample {
  float rank;
  SurfaceSample at;
};

float rank_of(int x, int y) {
  float r = 0.75487767f * static_cast<float>(x) + 0.56984029f * static_cast<float>(y);
  return r - std::floor(r);
}

/// What is known of a texel of a tile while its triangles go by.
struct Cell {
  std::uint32_t chart = 0xffffffff;
  std::vector<RankedSample> samples;
  float nearest2 = std::numeric_limits<float>::infinity();  // to the border, of a texel without samples
  SurfaceSample grazed;
};

class TileRaster {
 public:
  TileRaster(int x0, int y0, int side) : x0_(x0), y0_(y0), side_(side) {}

  void add(const PlacedTriangle& t, std::uint32_t number, const Bounds& b) {
    for (int y = b.y0; y < b.y1; ++y)
      for (int x = b.x0; x < b.x1; ++x) add_to(cells_[at(x, y)], t, number, x, y);
  }

  void take(int most, TileTexels& out) {
    for (int y = 0; y < TexelGrid::tile; ++y)
      for (int x = 0; x < TexelGrid::tile; ++x)
        take(cells_[std::size_t(y) * TexelGrid::tile + x], x0_ + x, y0_ + y, most, out);
  }

 private:
  std::size_t at(int x, int y) const { return std::size_t(y - y0_) * TexelGrid::tile + (x - x0_); }

  void add_to(Cell& cell, const PlacedTriangle& t, std::uint32_t number, int x, int y) {
    if (!cell.samples.empty() && cell.chart != t.chart) return;
    bool first = cell.samples.empty();
    const auto left = static_cast<float>(x), top = static_cast<float>(y), side = static_cast<float>(side_);
    for (int k = 0; k < side_ * side_; ++k) {
      const auto column = static_cast<float>(k % side_), row = static_cast<float>(k / side_);
      Spot2 p{left + (column + 0.5f) / side, top + (row + 0.5f) / side};
      Weights w = weights_at(t, p);
      if (inside(w)) cell.samples.push_back({rank_of(k % side_, k / side_), {number, {w.w[0], w.w[1], w.w[2]}}});
    }
    if (!cell.samples.empty()) {
      if (first) cell.chart = t.chart;
      return;
    }
    OnEdge e = nearest_on_border(t, {left + 0.5f, top + 0.5f});
    constexpr float reach2 = 2;  // the centre of a texel that is mixed is less than the diagonal of one away
    if (e.distance2 >= std::min(cell.nearest2, reach2)) return;
    cell.nearest2 = e.distance2;
    cell.chart = t.chart;
    e.weights = pulled_in(t, {left + 0.5f, top + 0.5f}, e.weights);
    cell.grazed = {number, {e.weights.w[0], e.weights.w[1], e.weights.w[2]}};
  }

  static void take(Cell& cell, int x, int y, int most, TileTexels& out) {
    if (cell.chart == 0xffffffff) return;
    auto first = static_cast<std::uint32_t>(out.samples.size());
    auto taken = std::min<std::size_t>(cell.samples.size(), most);
    if (taken < cell.samples.size()) std::ranges::stable_sort(cell.samples, {}, &RankedSample::rank);
    for (std::size_t i = 0; i < taken; ++i) out.samples.push_back(cell.samples[i].at);
    if (!taken) out.samples.push_back(cell.grazed);
    out.texels.push_back({x, y, first, static_cast<std::uint32_t>(out.samples.size()) - first});
  }

  int x0_, y0_, side_;
  std::vector<Cell> cells_ = std::vector<Cell>(std::size_t(TexelGrid::tile) * TexelGrid::tile);
};

}  // namespace

TexelGrid::TexelGrid(std::span<const PlacedTriangle> triangles, int width, int height)
    : triangles_(triangles),
      width_(width),
      height_(height),
      columns_((width + tile - 1) / tile),
      rows_((height + tile - 1) / tile),
      first_(n_tiles() + 1) {
  auto each_tile = [&](const PlacedTriangle& t, auto&& f) {
    Bounds b = bounds_of(t, width_, height_);
    for (int y = b.y0 / tile; y * tile < b.y1; ++y)
      for (int x = b.x0 / tile; x * tile < b.x1; ++x) f(std::size_t(y) * columns_ + x);
  };
  for (const auto& t : triangles) each_tile(t, [&](std::size_t i) { ++first_[i + 1]; });
  for (std::size_t i = 0; i + 1 < first_.size(); ++i) first_[i + 1] += first_[i];
  members_.resize(first_.back());
  auto next = first_;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    each_tile(triangles[i], [&](std::size_t cell) { members_[next[cell]++] = i; });
}

void TexelGrid::texels_of(std::size_t number, int side, int most, TileTexels& out) const {
  out.texels.clear();
  out.samples.clear();
  if (first_[number] == first_[number + 1]) return;
  int x0 = static_cast<int>(number % columns_) * tile, y0 = static_cast<int>(number / columns_) * tile;
  TileRaster raster(x0, y0, side);
  for (auto i = first_[number]; i < first_[number + 1]; ++i) {
    const PlacedTriangle& t = triangles_[members_[i]];
    Bounds b = bounds_of(t, width_, height_);
    b = {std::max(b.x0, x0), std::max(b.y0, y0), std::min(b.x1, x0 + tile), std::min(b.y1, y0 + tile)};
    raster.add(t, members_[i], b);
  }
  raster.take(most, out);
}

}  // namespace wrlkit::bake
