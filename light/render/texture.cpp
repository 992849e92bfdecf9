#include "light/render/texture.h"

#include <algorithm>
#include <array>

namespace wrlkit::drawing {
namespace {

/// Of coordinates far outside only the place within the period matters; NaN counts as 0.
double reduced(double v, Wrap wrap) {
  if (!std::isfinite(v)) return 0;
  if (wrap == Wrap::mirror) return v - 2 * std::floor(v / 2);
  return wrap == Wrap::repeat ? v - std::floor(v) : std::clamp(v, 0.0, 1.0);
}

/// The display value whose light is the mean of that of four.
std::uint8_t mean_of_light(const std::array<std::uint8_t, 4>& display) {
  static const auto light = [] {
    std::array<double, 256> out;
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = srgb_to_linear(static_cast<double>(v) / 255);
    return out;
  }();
  if (std::ranges::all_of(display, [&](std::uint8_t v) { return v == display[0]; })) return display[0];
  double sum = 0;
  for (const std::uint8_t v : display) sum += light[v];
  return static_cast<std::uint8_t>(255 * linear_to_srgb(sum / 4) + 0.5);
}

}  // namespace

std::shared_ptr<const Texture> Texture::make(const Image& image, Means means) {
  if (image.width <= 0 || image.height <= 0 || image.channels < 1 || image.channels > 4) return nullptr;
  if (image.pixels.size() < std::size_t(image.width) * image.height * image.channels) return nullptr;
  auto t = std::make_shared<Texture>();
  t->channels_ = image.channels;
  t->levels_.push_back({image.width, image.height, image.pixels});
  while (t->levels_.back().width > 1 || t->levels_.back().height > 1)
    t->levels_.push_back(t->half(t->levels_.back(), means));
  return t;
}

Texture::Level Texture::half(const Level& from, Means means) const {
  Level to{std::max(1, from.width / 2), std::max(1, from.height / 2), {}};
  to.pixels.resize(std::size_t(to.width) * to.height * channels_);
  auto pixel = [&](int x, int y, int c) {
    return from
        .pixels[(std::size_t(std::min(y, from.height - 1)) * from.width + std::min(x, from.width - 1)) * channels_ + c];
  };
  std::size_t at = 0;
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x)
      for (int c = 0; c < channels_; ++c) {
        const std::array<std::uint8_t, 4> four{pixel(2 * x, 2 * y, c), pixel(2 * x + 1, 2 * y, c),
                                               pixel(2 * x, 2 * y + 1, c), pixel(2 * x + 1, 2 * y + 1, c)};
        const bool is_alpha = has_alpha() && c == channels_ - 1;
        to.pixels[at++] = means == Means::light && !is_alpha
                              ? mean_of_light(four)
                              : static_cast<std::uint8_t>((four[0] + four[1] + four[2] + four[3] + 2) / 4);
      }
  return to;
}

void Texture::blend(const Level& level, double s, double t, const TextureSampler& sampler, double weight,
                    double out[4]) const {
  double x = s * level.width - 0.5, y = (1 - t) * level.height - 0.5;
  double fx = x - std::floor(x), fy = y - std::floor(y);
  auto ix = static_cast<std::int64_t>(std::floor(x)), iy = static_cast<std::int64_t>(std::floor(y));
  if (sampler.nearest) {
    fx = std::round(fx);
    fy = std::round(fy);
  }
  for (int k = 0; k < 4; ++k) {
    int dx = k & 1, dy = k >> 1;
    double w = weight * (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy) / 255;
    std::size_t at =
        std::size_t(wrapped(iy + dy, level.height, sampler.t)) * level.width + wrapped(ix + dx, level.width, sampler.s);
    for (int c = 0; c < channels_; ++c) out[c] += w * level.pixels[at * channels_ + c];
  }
}

Texel Texture::sample(double s, double t, double detail, const TextureSampler& sampler) const {
  double v[4] = {};
  s = reduced(s, sampler.s);
  t = reduced(t, sampler.t);
  double last = static_cast<double>(levels_.size() - 1);
  double level = detail > 1 ? std::min(std::log2(detail), last) : 0;
  auto fine = static_cast<std::size_t>(level);
  double coarse = level - static_cast<double>(fine);
  blend(levels_[fine], s, t, sampler, 1 - coarse, v);
  if (coarse > 0) blend(levels_[fine + 1], s, t, sampler, coarse, v);
  return {is_grey() ? V3(v[0]) : V3(v[0], v[1], v[2]), has_alpha() ? v[channels_ - 1] : 1};
}

Image image_of(std::span<const std::int32_t> sfimage) {
  if (sfimage.size() < 3) return {};
  std::int64_t width = sfimage[0], height = sfimage[1], channels = sfimage[2];
  if (width <= 0 || height <= 0 || channels < 1 || channels > 4) return {};
  if (width > static_cast<std::int64_t>(sfimage.size() - 3) / height) return {};
  Image image{static_cast<int>(width), static_cast<int>(height), static_cast<int>(channels), {}};
  for (std::int64_t y = height; y-- > 0;)
    for (std::int64_t x = 0; x < width; ++x) {
      auto pixel = static_cast<std::uint32_t>(sfimage[static_cast<std::size_t>(3 + y * width + x)]);
      for (std::int64_t c = channels; c-- > 0;) image.pixels.push_back(static_cast<std::uint8_t>(pixel >> (8 * c)));
    }
  return image;
}

}  // namespace wrlkit::drawing
