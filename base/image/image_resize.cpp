#include "base/image/image_resize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/image/srgb_table.h"

namespace wrlkit {
namespace {

constexpr double lobes = 3;

double lanczos(double x) {
  if (x == 0) return 1;
  if (std::abs(x) >= lobes) return 0;
  const double p = std::numbers::pi * x;
  return lobes * std::sin(p) * std::sin(p / lobes) / (p * p);
}

/// The pixels that one of the smaller picture is made of, along one side.
struct Tap {
  std::size_t first;
  std::vector<float> weights;  // they sum up to 1
};

std::vector<Tap> taps(int from, int to) {
  const double scale = static_cast<double>(from) / to;
  std::vector<Tap> out;
  for (int i = 0; i < to; ++i) {
    const double at = (i + 0.5) * scale, reach = lobes * scale;
    const int first = std::max(0, static_cast<int>(std::floor(at - reach))),
              end = std::min(from, static_cast<int>(std::ceil(at + reach)));
    Tap t{static_cast<std::size_t>(first), {}};
    double sum = 0;
    for (int k = first; k < end; ++k) sum += lanczos((k + 0.5 - at) / scale);
    for (int k = first; k < end; ++k) t.weights.push_back(static_cast<float>(lanczos((k + 0.5 - at) / scale) / sum));
    out.push_back(std::move(t));
  }
  return out;
}

/// As numbers that can be added: linear, and multiplied by alpha.
class Light {
 public:
  Light(int channels, PixelMeaning meaning)
      : channels_(static_cast<std::size_t>(channels)),
        color_(meaning == PixelMeaning::color),
        alpha_(color_ && channels % 2 == 0) {
    for (std::size_t i = 0; i < linear_.size(); ++i)
      linear_[i] =
          static_cast<float>(color_ ? srgb_to_linear(static_cast<double>(i) / 255) : static_cast<double>(i) / 255);
  }

  void read(const std::uint8_t* from, float* to) const {
    const std::size_t colors = channels_ - alpha_;
    const float a = alpha_ ? static_cast<float>(from[colors]) / 255 : 1;
    for (std::size_t c = 0; c < colors; ++c) to[c] = linear_[from[c]] * a;
    if (alpha_) to[colors] = a;
  }
  void write(const float* from, std::uint8_t* to) const {
    const std::size_t colors = channels_ - alpha_;
    const double a = alpha_ ? std::clamp(from[colors], 0.0f, 1.0f) : 1;
    for (std::size_t c = 0; c < colors; ++c)
      to[c] = color_ ? SrgbTable::get().byte(a > 0 ? from[c] / a : 0) : byte(from[c]);
    if (alpha_) to[colors] = byte(a);
  }

 private:
  static std::uint8_t byte(double v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0, 1.0) * 255 + 0.5); }

  std::size_t channels_;
  bool color_, alpha_;
  std::array<float, 256> linear_{};
};

}  // namespace

ImageSize fitting_size(const Image& image, int largest) {
  const int side = std::max(image.width, image.height);
  if (largest <= 0 || side <= largest) return {image.width, image.height};
  auto part = [&](int length) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(length) * largest / side)));
  };
  return {part(image.width), part(image.height)};
}

Image resized(const Image& from, ImageSize size, PixelMeaning meaning) {
  if (size == ImageSize{from.width, from.height}) return from;
  const auto n = static_cast<std::size_t>(from.channels), width = static_cast<std::size_t>(from.width),
             to_width = static_cast<std::size_t>(size.width);
  const Light light(from.channels, meaning);
  const auto across = taps(from.width, size.width), down = taps(from.height, size.height);
  // Row by row: each is made narrower once, and added to the rows that it is part of as long as they are open.
  Image to{size.width, size.height, from.channels,
           std::vector<std::uint8_t>(to_width * static_cast<std::size_t>(size.height) * n)};
  std::vector<float> row(width * n), narrow(to_width * n);
  std::vector<std::vector<float>> open(down.size());
  std::size_t begin = 0;  // rows of `to` before it are done
  for (std::size_t y = 0; y < static_cast<std::size_t>(from.height); ++y) {
    for (std::size_t x = 0; x < width; ++x) light.read(&from.pixels[(y * width + x) * n], &row[x * n]);
    std::ranges::fill(narrow, 0.0f);
    for (std::size_t x = 0; x < to_width; ++x)
      for (std::size_t k = 0; k < across[x].weights.size(); ++k)
        for (std::size_t c = 0; c < n; ++c)
          narrow[x * n + c] += across[x].weights[k] * row[(across[x].first + k) * n + c];
    for (std::size_t i = begin; i < down.size() && down[i].first <= y; ++i) {
      if (open[i].empty()) open[i].resize(narrow.size());
      for (std::size_t k = 0; k < narrow.size(); ++k) open[i][k] += down[i].weights[y - down[i].first] * narrow[k];
    }
    for (; begin < down.size() && down[begin].first + down[begin].weights.size() == y + 1; ++begin) {
      for (std::size_t x = 0; x < to_width; ++x)
        light.write(&open[begin][x * n], &to.pixels[(begin * to_width + x) * n]);
      open[begin] = {};
    }
  }
  return to;
}

}  // namespace wrlkit
