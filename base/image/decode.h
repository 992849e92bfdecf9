// Decoders that need no OpenImageIO: of the two types that nearly all scenes have, by libraries that are there at once,
// and of two old ones, which it does not read from memory, or not safely.
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

/// DirectDraw surfaces of BC1 to BC5 (DXT1, DXT3, DXT5, ...) or BC7 in one layer, without their smaller levels. Four
/// channels.
/// False, and why, for other kinds and when it is damaged.
bool decode_dds(std::string_view dds, Image& image, std::string& error);

/// SGI, 8 or 16 bits, run-length encoded or not. False, and why, when it is damaged.
bool decode_sgi(std::string_view sgi, Image& image, std::string& error);

/// PCX of 1 to 8 bits a pixel, with a palette or in the colours of an EGA, or of 24 or 32 bits, in 3 channels or 4.
/// False, and why, when it is damaged, of a CGA, or larger than its data can be: memory is at most proportional to
/// them.
bool decode_pcx(std::string_view pcx, Image& image, std::string& error);

/// An X bitmap, in 1 channel, black where its bits are set. False, and why, when it is damaged.
bool decode_xbm(std::string_view xbm, Image& image, std::string& error);

}  // namespace wrlkit
