// X bitmaps: pictures of two colours as a part of a program in C, which early browsers showed.
#pragma once
#include <optional>
#include <string_view>

namespace wrlkit {

struct XbmSize {
  int width, height;
};

/// By "#define NAME_width 16", within the first 4 kB; none: it is no X bitmap.
std::optional<XbmSize> xbm_size(std::string_view bytes);

}  // namespace wrlkit
