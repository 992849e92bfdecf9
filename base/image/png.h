// PNG (ISO/IEC 15948) as a list of chunks.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "base/image/image.h"

namespace wrlkit {

/// The picture without the chunks that do not change its pixels: colour profiles, times, texts. Nothing when a chunk is
/// damaged or missing. What a file says about its gamma, and about when and by what it was made, would make equal
/// pictures differ.
std::optional<std::string> essential_png(std::string_view png);

/// A picture that has all its pixels, 1 to 4 channels of 8 bits: each row by the filter that leaves the smallest
/// numbers, as the standard advises (12.8). Nothing but the pixels is written.
std::string png_of(const Image& image);

}  // namespace wrlkit
