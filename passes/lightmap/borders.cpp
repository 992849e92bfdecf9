#include "passes/lightmap/borders.h"

#include <numeric>

namespace wrlkit::bake {
namespace {

/// Texels of a level.
struct Level {
  static constexpr std::uint32_t none = 0, several = 0xffffffff;
  int width = 0, height = 0;
  std::vector<std::uint32_t> chart;

  std::uint32_t at(int x, int y) const { return chart[std::size_t(y) * width + x]; }
};

/// Of the next level. Its texels begin at even ones of this, or at odd ones.
Level half(const Level& from, int right = 0, int up = 0) {
  Level to{(from.width + right + 1) / 2, (from.height + up + 1) / 2, {}};
  to.chart.resize(std::size_t(to.width) * to.height);
  for (int y = 0; y < from.height; ++y)
    for (int x = 0; x < from.width; ++x) {
      auto& all = to.chart[std::size_t((y + up) / 2) * to.width + (x + right) / 2];
      const auto one = from.at(x, y);
      if (one != Level::none && one != all) all = all == Level::none ? one : Level::several;
    }
  return to;
}

bool is_separate(const Level& level) {
  constexpr std::ptrdiff_t rare = 50;  // one in that many
  const auto n_of_several = std::ranges::count(level.chart, Level::several);
  const auto n_of_any = std::ssize(level.chart) - std::ranges::count(level.chart, Level::none);
  return n_of_several * rare <= n_of_any;
}

/// The next level is, wherever its texels begin: charts may be apart by chance in one of them.
bool is_next_separate(const Level& level) {
  for (const int right : {0, 1})
    for (const int up : {0, 1})
      if (!is_separate(half(level, right, up))) return false;
  return true;
}

/// What of a texel of a level the charts have: a box, in texels of the picture, the ends included.
struct Taken {
  int left = 0, right = -1, low = 0, high = -1;

  bool empty() const { return right < left; }
  void add(int x, int y) {
    if (empty()) *this = {x, x, y, y};
    left = std::min(left, x);
    right = std::max(right, x);
    low = std::min(low, y);
    high = std::max(high, y);
  }
};

/// The picture in texels of a level.
class Blocks {
 public:
  Blocks(const ChartMap& map, int level)
      : map_(map),
        side_(1 << level),
        width_((map.width + side_ - 1) >> level),
        height_((map.height + side_ - 1) >> level),
        taken_(std::size_t(width_) * height_) {
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x)
        if (map.chart[std::size_t(y) * map.width + x]) taken_[at(x >> level, y >> level)].add(x, y);
  }

  /// Calls f(x, y, u, v) for each texel (x, y) of a block without a chart, with the place in the next block from
  /// which a chart comes nearest.
  template <class F>
  void each_beside(F&& f) const {
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u) {
        int near_u = u, near_v = v;
        if (!taken_[at(u, v)].empty() || !nearest(u, v, near_u, near_v)) continue;
        for (int y = v * side_; y < std::min((v + 1) * side_, map_.height); ++y)
          for (int x = u * side_; x < std::min((u + 1) * side_, map_.width); ++x)
            f(x, y, std::clamp(x, near_u * side_, (near_u + 1) * side_ - 1),
              std::clamp(y, near_v * side_, (near_v + 1) * side_ - 1));
      }
  }

 private:
  std::size_t at(int u, int v) const { return std::size_t(v) * width_ + u; }

  bool nearest(int u, int v, int& near_u, int& near_v) const {
    long least = -1;
    for (int q = std::max(0, v - 1); q <= std::min(height_ - 1, v + 1); ++q)
      for (int p = std::max(0, u - 1); p <= std::min(width_ - 1, u + 1); ++p) {
        const Taken& t = taken_[at(p, q)];
        if (t.empty()) continue;
        const long dx = std::max({t.left - ((u + 1) * side_ - 1), u * side_ - t.right, 0}),
                   dy = std::max({t.low - ((v + 1) * side_ - 1), v * side_ - t.high, 0});
        if (least >= 0 && dx * dx + dy * dy >= least) continue;
        least = dx * dx + dy * dy;
        near_u = p;
        near_v = q;
      }
    return least >= 0;
  }

  const ChartMap& map_;
  int side_, width_, height_;
  std::vector<Taken> taken_;
};

}  // namespace

int last_separate_level(const ChartMap& map) {
  Level level{map.width, map.height, {map.chart.begin(), map.chart.end()}};
  int last = 0;
  for (; last < most_mips && is_next_separate(level); ++last) level = half(level);
  return std::max(0, last - 1);
}

std::vector<std::uint32_t> sources_beyond_borders(const ChartMap& map, int level) {
  std::vector<std::uint32_t> sources(map.chart.size());
  std::iota(sources.begin(), sources.end(), 0u);
  if (level < 1) return sources;
  const auto width = static_cast<std::uint32_t>(map.width);
  Blocks(map, level).each_beside([&](int x, int y, int u, int v) {
    sources[static_cast<std::uint32_t>(y) * width + x] = static_cast<std::uint32_t>(v) * width + u;
  });
  return sources;
}

}  // namespace wrlkit::bake
