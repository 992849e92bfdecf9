#include "passes/combine_lightmap/page.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/parallel.h"
#include "passes/lightmap/borders.h"

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
    if (y0 > y1) {
      std::swap(x0, x1);
      std::swap(y0, y1);
    }
    if (y1 < top || y0 > bottom) continue;
    for (double y : {std::max(top, y0), std::min(bottom, y1)}) {
      double x = y1 > y0 ? x0 + (x1 - x0) * (y - y0) / (y1 - y0) : x0;
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (y1 == y0) {
      left = std::min(left, x1);
      right = std::max(right, x1);
    }
  }
  return {left, right};
}

/// The nearest point of an edge, as a share of it, and the square of its distance.
std::array<double, 2> nearest_on_edge(const PageTriangle& t, int i, double x, double y) {
  int k = (i + 1) % 3;
  double ex = t.x[k] - t.x[i], ey = t.y[k] - t.y[i], square = ex * ex + ey * ey;
  double at = square > 0 ? std::clamp(((x - t.x[i]) * ex + (y - t.y[i]) * ey) / square, 0.0, 1.0) : 0;
  const double dx = x - t.x[i] - at * ex, dy = y - t.y[i] - at * ey;
  return {at, dx * dx + dy * dy};
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
  double nearest = HUGE_VAL;
  std::array<double, 3> on_edge{};
  for (int i = 0; i < 3; ++i) {
    auto [at, square] = nearest_on_edge(t, i, x, y);
    if (square >= nearest) continue;
    nearest = square;
    on_edge = {};
    on_edge[i] = 1 - at;
    on_edge[(i + 1) % 3] = at;
  }
  p.distance = std::sqrt(nearest);
  if (low < -far || high > 1 + far) p.weights = on_edge;
  return p;
}

/// The page, or a smaller version of it.
struct Level {
  int width, height;
  std::vector<Texel4> texels;
  std::vector<char> known;
};

/// A texel is the mean of those of its four that are known.
Level half(const Level& from) {
  Level to{(from.width + 1) / 2, (from.height + 1) / 2, {}, {}};
  to.texels.resize(std::size_t(to.width) * to.height);
  to.known.resize(to.texels.size());
  parallel_for(static_cast<std::size_t>(to.height), [&](std::size_t y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(to.width); ++x) {
      std::array<int, 4> sum{};
      int n = 0;
      for (std::size_t v = 2 * y; v < std::min<std::size_t>(2 * y + 2, from.height); ++v)
        for (std::size_t u = 2 * x; u < std::min<std::size_t>(2 * x + 2, from.width); ++u) {
          const std::size_t i = v * from.width + u;
          if (!from.known[i]) continue;
          for (std::size_t c = 0; c < 4; ++c) sum[c] += from.texels[i].rgba[c];
          ++n;
        }
      const std::size_t at = y * to.width + x;
      to.known[at] = n > 0;
      for (std::size_t c = 0; c < 4 && n; ++c) to.texels[at].rgba[c] = static_cast<std::uint8_t>((sum[c] + n / 2) / n);
    }
  });
  return to;
}

/// Texels that are not known take those of the smaller version (pull and push; Gortler et al. 1996).
void fill(Level& fine, const Level& coarse) {
  parallel_for(static_cast<std::size_t>(fine.height), [&](std::size_t y) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(fine.width); ++x)
      if (const std::size_t i = y * fine.width + x; !fine.known[i])
        fine.texels[i] = coarse.texels[y / 2 * coarse.width + x / 2];
  });
}

}  // namespace

Page::Page(int width, int height, double reach)
    : width_(width),
      height_(height),
      reach_(reach),
      texels_(std::size_t(width) * height),
      distance_(texels_.size(), nobody),
      chart_(texels_.size()) {}

/// A band of rows, by texel: how far its owner is, and who that is. Colours come last, so that each texel has one only.
class Page::Band {
 public:
  Band(Page& page, std::span<const PageTriangle> triangles, int begin, int end)
      : page_(page), triangles_(triangles), begin_(begin), end_(end), owner_(std::size_t(end - begin) * page.width_) {}

  bool paint(const Paint& paint) {
    // Most texels lie within a triangle, and are not looked at again when those next to one are sought.
    const bool whole = own(0) && own(page_.reach_);
    constexpr double half_diagonal = 0.71;
    const double touching = page_.reach_ > 0 ? 1 + half_diagonal / page_.reach_ * (nobody - 2) : 0;
    for (int y = begin_; y < end_; ++y)
      for (int x = 0; x < page_.width_; ++x) {
        const std::size_t at = std::size_t(y) * page_.width_ + x;
        if (page_.distance_[at] == nobody) continue;
        const auto owner = owner_[index(x, y)];
        const PageTriangle& t = triangles_[owner];
        if (page_.distance_[at] <= touching) page_.chart_[at] = t.chart;
        page_.texels_[at] = paint(owner, position(t, t.area(), x + 0.5, y + 0.5).weights, x + 0.5, y + 0.5);
      }
    return whole;
  }

 private:
  std::size_t index(int x, int y) const { return std::size_t(y - begin_) * page_.width_ + x; }

  /// The square of the distance that an owner at that one must be nearer than, or a little more: distances are kept in
  /// 8 bits.
  static std::array<double, 256> limits_of(double reach) {
    std::array<double, 256> out{};
    for (std::size_t i = 1; i < out.size(); ++i) {
      const double distance = reach * static_cast<double>(i) / (nobody - 2);
      out[i] = distance * distance;
    }
    if (!(reach > 0)) out.fill(HUGE_VAL);
    return out;
  }

  /// Triangles own the texels within `reach` that nobody nearer has. False when there was too much to do.
  bool own(double reach) {
    const auto limits = limits_of(reach);
    budget_ = most_layers * (static_cast<std::uint64_t>(end_ - begin_) * page_.width_ + triangles_.size());
    for (std::size_t i = 0; i < triangles_.size() && budget_ > 0; ++i) {
      const auto& t = triangles_[i];
      auto [top, bottom] = std::ranges::minmax(t.y);
      if (bottom + reach < begin_ || top - reach > end_) continue;
      if (std::abs(t.area()) > 0) own(t, static_cast<std::uint32_t>(i), reach, limits);
    }
    return budget_ > 0;
  }

  void own(const PageTriangle& t, std::uint32_t number, double reach, const std::array<double, 256>& limits) {
    const double area = t.area();
    const auto [first, last] = std::ranges::minmax(t.x);
    const auto [top, bottom] = std::ranges::minmax(t.y);
    /// The square of the distance from its box, which is less than that from the triangle.
    auto beyond = [left = first, right = last, high = top, low = bottom](double x, double y) {
      const double dx = std::max({left - x, x - right, 0.0}), dy = std::max({high - y, y - low, 0.0});
      return dx * dx + dy * dy;
    };
    auto row = [&](double y) { return static_cast<int>(std::clamp(y, double(begin_), double(end_))); };
    for (int y = row(top - reach); y < row(bottom + reach + 1) && budget_ > 0; ++y) {
      auto [left, right] = columns(t, y + 0.5 - reach, y + 0.5 + reach);
      int begin = static_cast<int>(std::clamp(left - reach, 0.0, double(page_.width_))),
          end = static_cast<int>(std::clamp(right + reach + 1, 0.0, double(page_.width_)));
      budget_ -= std::min<std::uint64_t>(budget_, static_cast<std::uint64_t>(std::max(end - begin, 1)));
      for (int x = begin; x < end; ++x) {
        auto& least = page_.distance_[std::size_t(y) * page_.width_ + x];
        if (least == 0 || beyond(x + 0.5, y + 0.5) >= limits[least]) continue;
        const auto p = position(t, area, x + 0.5, y + 0.5);
        if (p.distance > 0 && !(p.distance < reach)) continue;
        const auto distance = static_cast<std::uint8_t>(p.distance > 0 ? 1 + p.distance / reach * (nobody - 2) : 0);
        if (distance >= least) continue;
        least = distance;
        owner_[index(x, y)] = number;
      }
    }
  }

  Page& page_;
  std::span<const PageTriangle> triangles_;
  int begin_, end_;
  std::uint64_t budget_ = 0;
  std::vector<std::uint32_t> owner_;
};

bool Page::paint(std::span<const PageTriangle> triangles, const Paint& paint) {
  std::atomic<bool> whole = true;
  const auto n_bands = static_cast<std::size_t>((height_ + rows_of_band - 1) / rows_of_band);
  parallel_for(n_bands, [&](std::size_t i) {
    const int begin = static_cast<int>(i) * rows_of_band;
    if (!Band(*this, triangles, begin, std::min(height_, begin + rows_of_band)).paint(paint)) whole = false;
  });
  return whole;
}

/// One texel beyond a chart its surface goes on as a plane, which is better than what is copied.
void Page::extend(std::vector<Texel4>& texels) const {
  const bake::ChartMap map{chart_, width_, height_};
  auto sources = bake::sources_beyond_borders(map, bake::last_separate_level(map));
  const double beside = reach_ > 0 ? 1 + 1 / reach_ * (nobody - 2) : 0;
  for (std::uint32_t i = 0; i < sources.size(); ++i)
    if (distance_[i] <= beside) sources[i] = i;
  bake::extend_borders(texels, sources);
}

Image Page::image(int channels) const {
  std::vector<char> known(distance_.size());
  for (std::size_t i = 0; i < known.size(); ++i) known[i] = distance_[i] != nobody;
  std::vector<Level> levels{{width_, height_, texels_, std::move(known)}};
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(half(levels.back()));
  if (!levels.back().known[0]) levels.back().texels[0] = {{0, 0, 0, 255}};
  for (std::size_t l = levels.size() - 1; l-- > 0;) fill(levels[l], levels[l + 1]);
  extend(levels[0].texels);
  Image out{width_, height_, channels, {}};
  out.pixels.reserve(texels_.size() * channels);
  for (const Texel4& t : levels[0].texels)
    out.pixels.insert(out.pixels.end(), t.rgba.begin(), t.rgba.begin() + channels);
  return out;
}

}  // namespace wrlkit::combine
