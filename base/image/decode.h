// Decoders of the two types that nearly all scenes have, by libraries that are there at once.
#pragma once
#include <string>
#include <string_view>

#include "base/image/image.h"

namespace wrlkit {

/// PNG by libpng: as many channels as read_image_header says, 16 bits as 8. False, and why, when it is damaged.
bool decode_png(std::string_view png, Image& image, std::string& error);

/// Whether a JPEG is grey or YCbCr, as nearly all are: not CMYK, which comes from printing.
bool is_plain_jpeg(std::string_view jpeg);
/// One of those by libjpeg-turbo, in 1 channel or 3. Where data are missing at the end, what is there is shown, as
/// browsers do. False, and why, when it is damaged.
bool decode_jpeg(std::string_view jpeg, Image& image, std::string& error);

}  // namespace wrlkit
