// How large pictures with baked light may be, as one option: bytes, or texels by width and height.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/math/digits.h"
#include "base/text/amounts.h"

namespace wrlkit {

struct LightmapSize {
  static constexpr std::string_view type = "SIZE";
  std::uint64_t bytes = 0, texels = 0;  // 0: as many as it takes

  bool read(std::string_view text) {
    bytes = texels = 0;
    const auto x = text.find('x');
    if (x == text.npos) {
      bytes = size_of(std::string(text));
      return bytes > 0;
    }
    const std::uint64_t width = side(text.substr(0, x)), height = side(text.substr(x + 1));
    texels = width * height;
    return texels > 0 && texels <= most_texels;
  }
  /// Of the pass `combine-lightmap`; empty where nothing is set.
  std::string pass_option() const {
    return bytes ? "budget=" + std::to_string(bytes) : texels ? "texels=" + std::to_string(texels) : "";
  }

 private:
  static constexpr std::uint64_t longest_side = 1 << 16, most_texels = 1 << 28;

  static std::uint64_t side(std::string_view text) {
    std::uint64_t v = 0;
    return read_number(text, v) && v <= longest_side ? v : 0;
  }
};

}  // namespace wrlkit
