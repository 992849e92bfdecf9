// The curves of base/image/srgb.h for pictures of millions of pixels: by table, several times as fast.
#pragma once
#include <array>
#include <cstdint>

#include "base/image/srgb.h"

namespace wrlkit {

class SrgbTable {
 public:
  static const SrgbTable& get() {
    static const SrgbTable table;
    return table;
  }

  /// As srgb_to_linear, to within 1e-7 for numbers in [0, 1].
  double linear(double display) const {
    if (!(display >= 0 && display < 1)) return srgb_to_linear(display);
    const double at = display * steps;
    const auto i = static_cast<std::size_t>(at);
    return linear_[i] + (at - static_cast<double>(i)) * (linear_[i + 1] - linear_[i]);
  }

  /// The byte of linear_to_srgb: 255 times that, rounded.
  std::uint8_t byte(double linear) const {
    if (!(linear > 0)) return 0;
    if (linear >= 1) return 255;
    std::uint8_t b = guess_[static_cast<std::size_t>(linear * steps)];
    while (b < 255 && linear >= threshold_[b]) ++b;
    return b;
  }

 private:
  static constexpr std::size_t steps = 4096;

  SrgbTable() {
    for (std::size_t i = 0; i <= steps; ++i) linear_[i] = srgb_to_linear(static_cast<double>(i) / steps);
    for (std::size_t b = 0; b < 255; ++b) threshold_[b] = srgb_to_linear((static_cast<double>(b) + 0.5) / 255);
    for (std::size_t i = 0; i < steps; ++i)
      guess_[i] = static_cast<std::uint8_t>(
          std::lower_bound(threshold_.begin(), threshold_.end(), static_cast<double>(i) / steps) - threshold_.begin());
  }

  std::array<double, steps + 1> linear_;
  std::array<double, 255> threshold_;      // from which on the byte is one more
  std::array<std::uint8_t, steps> guess_;  // of the lower end of each step
};

}  // namespace wrlkit
