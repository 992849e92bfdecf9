// Pictures made smaller. Each pixel is a sum of those around its place, weighted by Lanczos' kernel of three lobes.
#pragma once
#include <cstdint>

#include "base/image/image.h"

namespace wrlkit {

/// What the numbers of a picture mean. color: display-referred colours, which are added in linear light and by their
/// alpha, so that fine patterns stay as bright as they are and what is clear has no colour. data: normals and the like,
/// added as they are.
enum class PixelMeaning : std::uint8_t { color, data };

/// The size at which no side is longer than `largest`, with the same shape; its own when that is 0 or no side is.
struct ImageSize {
  int width, height;
  bool operator==(const ImageSize&) const = default;
};
ImageSize fitting_size(const Image&, int largest);

/// The picture at a size that is no larger along either side. O(pixels * lobes).
Image resized(const Image&, ImageSize, PixelMeaning);

}  // namespace wrlkit
