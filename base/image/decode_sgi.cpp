// Pictures of Silicon Graphics' workstations (.rgb, .rgba, .bw, .sgi), as Inventor and early VRML have them: "The SGI
// Image File Format", version 1.00. OpenImageIO reads them from files only.
#include <algorithm>

#include "base/image/decode.h"

namespace wrlkit {
namespace {

constexpr std::size_t header_size = 512;

std::uint32_t byte(std::string_view b, std::size_t i) { return i < b.size() ? static_cast<unsigned char>(b[i]) : 0; }
std::uint32_t be16(std::string_view b, std::size_t i) { return byte(b, i) << 8 | byte(b, i + 1); }
std::uint32_t be32(std::string_view b, std::size_t i) { return be16(b, i) << 16 | be16(b, i + 2); }

/// A run-length encoded row: a count in the low seven bits, with the eighth that many pixels as they are, without it
/// one that is repeated; 0 ends the row. False: it lies outside of the file or has too few pixels.
bool unpack_row(std::string_view row, std::size_t depth, std::uint8_t* to, std::size_t step, std::size_t width) {
  std::size_t at = 0, x = 0;
  while (x < width) {
    if (at + depth > row.size()) return false;
    const std::uint32_t code = byte(row, at + depth - 1), count = code & 0x7f;
    at += depth;
    if (count == 0) return false;
    const bool repeats = !(code & 0x80);
    if (at + depth * (repeats ? 1 : count) > row.size()) return false;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (x < width) to[x++ * step] = static_cast<std::uint8_t>(byte(row, at));  // of 16 bits the upper ones
      if (!repeats) at += depth;
    }
    if (repeats) at += depth;
  }
  return true;
}

}  // namespace

bool decode_sgi(std::string_view sgi, Image& image, std::string& error) {
  const auto header = read_image_header(sgi);
  const std::size_t depth = byte(sgi, 3);
  const bool packed = byte(sgi, 2) == 1;
  error = "its data are damaged";
  if (!header || depth < 1 || depth > 2) return false;
  const auto width = static_cast<std::size_t>(header->width), height = static_cast<std::size_t>(header->height),
             channels = static_cast<std::size_t>(header->channels), all = std::max<std::size_t>(be16(sgi, 10), 1);
  const std::size_t tables = header_size + 8 * height * all;
  if (sgi.size() < (packed ? tables : header_size + depth * width * height * channels)) return false;
  image = {header->width, header->height, header->channels, {}};
  image.pixels.resize(width * height * channels);
  for (std::size_t c = 0; c < channels; ++c)
    for (std::size_t y = 0; y < height; ++y) {
      std::uint8_t* to = &image.pixels[(height - 1 - y) * width * channels + c];  // the first row is the lowest
      const std::size_t row = c * height + y;
      if (packed) {
        const std::size_t begin = be32(sgi, header_size + 4 * row),
                          length = be32(sgi, header_size + 4 * (height * all + row));
        if (begin > sgi.size() || !unpack_row(sgi.substr(begin, length), depth, to, channels, width)) return false;
      } else {
        for (std::size_t x = 0; x < width; ++x)
          to[x * channels] = static_cast<std::uint8_t>(byte(sgi, header_size + depth * (row * width + x)));
      }
    }
  error.clear();
  return true;
}

}  // namespace wrlkit
