#include "passes/patches/flat_picture.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace wrlkit::light {
namespace {

double cross2(const Place& a, const Place& b, const Place& c) { return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]); }
double distance(const Place& a, const Place& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

struct Extent {
  Place low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};

  explicit Extent(std::span<const FlatPatch> patches) {
    for (const auto& p : patches)
      for (const auto& c : p.corners)
        for (std::size_t i = 0; i < 2; ++i) low[i] = std::min(low[i], c[i]), high[i] = std::max(high[i], c[i]);
  }
};

/// Corners of patches that are one point, although each was printed by itself. A point joins the first one that is near
/// enough, so it cannot drift.
class CornerTable {
 public:
  explicit CornerTable(double tolerance) : tolerance_(tolerance), cell_(4 * tolerance) {}

  std::uint32_t number(const Place& p) {
    const std::int64_t x = cell_of(p[0]), y = cell_of(p[1]);
    for (auto dx : {0, -1, 1})
      for (auto dy : {0, -1, 1}) {
        const auto [from, to] = cells_.equal_range(key(x + dx, y + dy));
        for (auto i = from; i != to; ++i)
          if (distance(points_[i->second], p) <= tolerance_) return i->second;
      }
    cells_.emplace(key(x, y), static_cast<std::uint32_t>(points_.size()));
    points_.push_back(p);
    return static_cast<std::uint32_t>(points_.size() - 1);
  }
  std::size_t size() const { return points_.size(); }

 private:
  std::int64_t cell_of(double v) const { return static_cast<std::int64_t>(std::floor(v / cell_)); }
  static std::uint64_t key(std::int64_t x, std::int64_t y) { return static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(y); }

  double tolerance_, cell_;
  std::unordered_multimap<std::uint64_t, std::uint32_t> cells_;
  std::vector<Place> points_;
};

double angle_at(const FlatPatch& p, int i) {
  const auto &a = p.corners[i], &b = p.corners[(i + 1) % 3], &c = p.corners[(i + 2) % 3];
  return std::atan2(std::fabs(cross2(a, b, c)), (b[0] - a[0]) * (c[0] - a[0]) + (b[1] - a[1]) * (c[1] - a[1]));
}

/// Three colours for each patch.
std::vector<std::array<V3, 3>> corner_colors(std::span<const FlatPatch> patches, bool smooth) {
  std::vector<std::array<V3, 3>> out;
  out.reserve(patches.size());
  for (const auto& p : patches) out.push_back({p.color, p.color, p.color});
  if (!smooth || patches.empty()) return out;
  double area = 0;
  for (const auto& p : patches) area += std::fabs(cross2(p.corners[0], p.corners[1], p.corners[2]));
  CornerTable table(1e-3 * std::sqrt(area / static_cast<double>(patches.size())));
  std::vector<std::array<std::uint32_t, 3>> numbers(patches.size());
  std::vector<V3> sum;
  std::vector<double> weight;
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (int i = 0; i < 3; ++i) {
      const auto n = numbers[p][i] = table.number(patches[p].corners[i]);
      sum.resize(table.size());
      weight.resize(table.size());
      const double angle = angle_at(patches[p], i);
      sum[n] += angle * patches[p].color;
      weight[n] += angle;
    }
  for (std::size_t p = 0; p < patches.size(); ++p)
    for (int i = 0; i < 3; ++i)
      if (weight[numbers[p][i]] > 0) out[p][i] = (1 / weight[numbers[p][i]]) * sum[numbers[p][i]];
  return out;
}

/// A picture that is being drawn: sums of samples.
class Canvas {
 public:
  Canvas(FloatPicture& picture, const PictureOptions& options) : picture_(picture), options_(options), hits_(picture.pixels.size()) {}

  void triangle(const std::array<Place, 3>& corners, const std::array<V3, 3>& colors) {
    const double step = options_.texel / options_.samples;
    std::array<Place, 3> c;  // in samples, y down
    for (int i = 0; i < 3; ++i) c[i] = {(corners[i][0] - picture_.low[0]) / step, picture_.height * options_.samples - (corners[i][1] - picture_.low[1]) / step};
    const double area = cross2(c[0], c[1], c[2]);
    if (area == 0) return;
    auto range = [&](int axis, int n) {
      const auto [low, high] = std::minmax({c[0][axis], c[1][axis], c[2][axis]});
      return std::pair{std::clamp(static_cast<int>(std::ceil(low - 0.5)), 0, n), std::clamp(static_cast<int>(std::ceil(high - 0.5)), 0, n)};
    };
    const auto [y0, y1] = range(1, picture_.height * options_.samples);
    const auto [x0, x1] = range(0, picture_.width * options_.samples);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const Place p{x + 0.5, y + 0.5};
        const double a = cross2(c[1], c[2], p) / area, b = cross2(c[2], c[0], p) / area;
        if (a >= 0 && b >= 0 && a + b <= 1) add(x, y, a * colors[0] + b * colors[1] + (1 - a - b) * colors[2]);
      }
  }

  void finish() {
    V3 sum;
    double n = 0;
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      if (!hits_[i]) continue;
      picture_.pixels[i] = (1.0 / hits_[i]) * picture_.pixels[i];
      sum += picture_.pixels[i];
      ++n;
    }
    for (int round = 0; round < options_.border; ++round) grow();
    for (std::size_t i = 0; i < hits_.size(); ++i)
      if (!hits_[i] && n > 0) picture_.pixels[i] = (1 / n) * sum;
  }

 private:
  void add(int x, int y, const V3& color) {
    picture_.at(x / options_.samples, y / options_.samples) += color;
    ++hits_[index(x / options_.samples, y / options_.samples)];
  }
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x); }

  /// Texels beside those that have a colour get the mean of these.
  void grow() {
    std::vector<std::pair<std::size_t, V3>> grown;
    for (int y = 0; y < picture_.height; ++y)
      for (int x = 0; x < picture_.width; ++x) {
        if (hits_[index(x, y)]) continue;
        V3 sum;
        int n = 0;
        for (int v = std::max(0, y - 1); v <= std::min(picture_.height - 1, y + 1); ++v)
          for (int u = std::max(0, x - 1); u <= std::min(picture_.width - 1, x + 1); ++u)
            if (hits_[index(u, v)]) sum += picture_.at(u, v), ++n;
        if (n) grown.emplace_back(index(x, y), (1.0 / n) * sum);
      }
    for (const auto& [i, color] : grown) picture_.pixels[i] = color, hits_[i] = 1;
  }

  FloatPicture& picture_;
  const PictureOptions& options_;
  std::vector<std::uint32_t> hits_;  // samples
};

}  // namespace

PictureFrame PictureFrame::facing(const V3& normal, const V3& origin) {
  constexpr double upright = 0.99;  // beyond that cosine it lies flat
  const V3 vertical = std::fabs(normal.y) < upright ? V3(0, 1, 0) : V3(0, 0, -1);
  const V3 up = unit(vertical - dot(vertical, normal) * normal);
  return {origin, cross(up, normal), up};
}

std::array<int, 2> picture_size(std::span<const FlatPatch> patches, const PictureOptions& options) {
  constexpr double most = 1 << 24;
  const Extent e(patches);
  auto side = [&](std::size_t i) { return static_cast<int>(std::clamp(std::ceil((e.high[i] - e.low[i]) / options.texel - 1e-6), 1.0, most)) + 2 * options.border; };
  return {side(0), side(1)};
}

FloatPicture draw(std::span<const FlatPatch> patches, const PictureOptions& options) {
  FloatPicture picture;
  const auto [width, height] = picture_size(patches, options);
  const Extent e(patches);
  picture.width = width;
  picture.height = height;
  picture.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  picture.low = {e.low[0] - options.border * options.texel, e.low[1] - options.border * options.texel};
  const auto colors = corner_colors(patches, options.smooth);
  Canvas canvas(picture, options);
  for (std::size_t p = 0; p < patches.size(); ++p) canvas.triangle(patches[p].corners, colors[p]);
  canvas.finish();
  return picture;
}

}  // namespace wrlkit::light
