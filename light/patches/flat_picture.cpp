#include "light/patches/flat_picture.h"

#include <algorithm>
#include <cstdint>

namespace wrlkit::light {
namespace {

double cross2(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A picture that is being drawn: sums of samples.
class Drawing {
 public:
  Drawing(FloatPicture& picture, const Vec2& low, const PictureOptions& options)
      : picture_(picture), low_(low), options_(options), hits_(picture.pixels.size()) {}

  void triangle(const std::array<Vec2, 3>& corners, const std::array<V3, 3>& colors) {
    const double step = options_.texel / options_.samples;
    std::array<Vec2, 3> c;  // in samples, y down
    for (std::size_t i = 0; i < 3; ++i)
      c[i] = {(corners[i][0] - low_[0]) / step, picture_.height * options_.samples - (corners[i][1] - low_[1]) / step};
    const double area = cross2(c[0], c[1], c[2]);
    if (!(std::fabs(area) > 0)) return;
    auto range = [&](std::size_t axis, int n) {
      const auto [low, high] = std::minmax({c[0][axis], c[1][axis], c[2][axis]});
      auto first = [&](double v) {
        return static_cast<int>(std::clamp(std::ceil(v - 0.5), 0.0, static_cast<double>(n)));
      };
      return std::pair{first(low), first(high)};
    };
    const auto [y0, y1] = range(1, picture_.height * options_.samples);
    const auto [x0, x1] = range(0, picture_.width * options_.samples);
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const Vec2 p{x + 0.5, y + 0.5};
        const double a = cross2(c[1], c[2], p) / area, b = cross2(c[2], c[0], p) / area;
        if (a >= 0 && b >= 0 && a + b <= 1) add(x, y, a * colors[0] + b * colors[1] + (1 - a - b) * colors[2]);
      }
  }

  void finish() {
    for (std::size_t i = 0; i < hits_.size(); ++i)
      if (hits_[i]) picture_.pixels[i] = (1.0 / hits_[i]) * picture_.pixels[i];
    grow();
  }

 private:
  static constexpr std::uint32_t waits = 0xffffffffu;

  void add(int x, int y, const V3& color) {
    picture_.at(x / options_.samples, y / options_.samples) += color;
    ++hits_[index(x / options_.samples, y / options_.samples)];
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x);
  }

  template <class F>
  void each_neighbour(std::size_t i, F&& f) const {
    const int x = static_cast<int>(i % static_cast<std::size_t>(picture_.width)),
              y = static_cast<int>(i / static_cast<std::size_t>(picture_.width));
    for (int v = std::max(0, y - 1); v <= std::min(picture_.height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(picture_.width - 1, x + 1); ++u) f(index(u, v));
  }

  /// Ring by ring, texels next to those that have a colour get the mean of these.
  void grow() {
    std::vector<std::size_t> ring, next;
    auto wait = [&](std::size_t i) {
      if (!hits_[i]) {
        hits_[i] = waits;
        next.push_back(i);
      }
    };
    for (std::size_t i = 0; i < hits_.size(); ++i)
      if (hits_[i] && hits_[i] != waits) each_neighbour(i, wait);
    while (!next.empty()) {
      ring.swap(next);
      next.clear();
      for (auto i : ring) {
        V3 sum;
        int n = 0;
        each_neighbour(i, [&](std::size_t j) {
          if (hits_[j] && hits_[j] != waits) {
            sum += picture_.pixels[j];
            ++n;
          }
        });
        picture_.pixels[i] = (1.0 / n) * sum;
      }
      for (auto i : ring) hits_[i] = 1;
      for (auto i : ring) each_neighbour(i, wait);
    }
  }

  FloatPicture& picture_;
  Vec2 low_;  // of the lower left corner of the picture
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

std::array<int, 2> picture_size(const Box2& box, const PictureOptions& options) {
  constexpr double most = 1 << 24;
  auto side = [&](std::size_t i) {
    return static_cast<int>(std::clamp(std::ceil((box.high[i] - box.low[i]) / options.texel - 1e-6), 1.0, most)) +
           2 * options.border;
  };
  return {side(0), side(1)};
}

FloatPicture draw(std::span<const FlatPatch> patches, const Box2& box, const PictureOptions& options) {
  FloatPicture picture;
  const auto [width, height] = picture_size(box, options);
  picture.width = width;
  picture.height = height;
  picture.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const double border = options.border * options.texel;
  Drawing drawing(picture, {box.low[0] - border, box.low[1] - border}, options);
  for (const auto& p : patches) drawing.triangle(p.corners, p.colors);
  drawing.finish();
  return picture;
}

}  // namespace wrlkit::light
