// PCX of ZSoft's PC Paintbrush: the "ZSoft PCX File Format Technical Reference Manual", versions 2.5, 2.8, 3.0.
#include <algorithm>

#include "base/image/decode.h"

namespace wrlkit {
namespace {

constexpr std::size_t pcx_header = 128, pcx_palette = 3 * 256;
constexpr std::size_t pcx_most_of_byte = 32;  // two bytes are at most 63

/// What an EGA shows as long as no program chooses other colours: bits of blue, green, red, and of brightness.
constexpr std::uint8_t ega_colors[16][3] = {
    {0x00, 0x00, 0x00}, {0x00, 0x00, 0xaa}, {0x00, 0xaa, 0x00}, {0x00, 0xaa, 0xaa},
    {0xaa, 0x00, 0x00}, {0xaa, 0x00, 0xaa}, {0xaa, 0x55, 0x00}, {0xaa, 0xaa, 0xaa},
    {0x55, 0x55, 0x55}, {0x55, 0x55, 0xff}, {0x55, 0xff, 0x55}, {0x55, 0xff, 0xff},
    {0xff, 0x55, 0x55}, {0xff, 0x55, 0xff}, {0xff, 0xff, 0x55}, {0xff, 0xff, 0xff}};

std::uint32_t pcx_byte(std::string_view b, std::size_t i) {
  return i < b.size() ? static_cast<unsigned char>(b[i]) : 0;
}

/// All rows, unpacked: two upper bits set, and the byte is a count of the next one. False: there are too few.
bool unpack_pcx(std::string_view packed, bool runs, std::vector<std::uint8_t>& rows) {
  std::size_t done = 0, at = 0;
  while (done < rows.size() && at < packed.size()) {
    std::uint32_t value = pcx_byte(packed, at++), count = 1;
    if (runs && value >= 0xc0) {
      if (at == packed.size()) return false;
      count = value & 0x3f;
      value = pcx_byte(packed, at++);
    }
    for (; count > 0 && done < rows.size(); --count) rows[done++] = static_cast<std::uint8_t>(value);
  }
  return done == rows.size();
}

struct PcxLayout {
  std::size_t width, height, bits, planes, row;  // bits of a pixel in a plane; bytes of a row of a plane
  bool has_colors() const { return bits == 8 && planes >= 3; }
  bool is_cga() const { return bits == 2 && planes == 1; }
  bool is_known() const { return has_colors() || bits * planes <= 4 || (bits == 8 && planes == 1); }
};

/// What a pixel has in all planes, the first one lowest.
std::uint32_t pcx_index(const PcxLayout& l, const std::uint8_t* row, std::size_t x) {
  std::uint32_t index = 0;
  const std::size_t bit = x * l.bits, shift = 8 - l.bits - bit % 8;
  for (std::size_t p = 0; p < l.planes; ++p)
    index |= (row[p * l.row + bit / 8] >> shift & ((1u << l.bits) - 1)) << p * l.bits;
  return index;
}

/// Versions 2.5 and 2.8 without a palette leave anything at all in its place.
bool has_header_colors(std::string_view pcx) { return pcx_byte(pcx, 1) != 0 && pcx_byte(pcx, 1) != 3; }

/// The colours of indices: behind the pictures for 256, else in the header. A picture of two colours that has none is
/// black and white, one of up to 16 has those of the EGA, and one of 256 is grey.
std::string pcx_colors(std::string_view pcx, const PcxLayout& l) {
  std::string grey, ega;
  const bool two = l.bits * l.planes == 1;
  for (int i = 0; i < 256; ++i) grey.append(3, static_cast<char>(two && i > 0 ? 255 : i));
  if (l.bits == 8) {
    const bool has = pcx.size() > pcx_header + pcx_palette && pcx_byte(pcx, pcx.size() - pcx_palette - 1) == 12;
    return has ? std::string(pcx.substr(pcx.size() - pcx_palette)) : grey;
  }
  const auto colors = pcx.substr(16, 48);
  if (two && (!has_header_colors(pcx) || colors.substr(0, 3) == colors.substr(3, 3))) return grey;
  if (has_header_colors(pcx)) return std::string(colors);
  for (const auto& color : ega_colors) ega.append(std::begin(color), std::end(color));
  return ega;
}

/// Why a picture cannot be read, before memory is taken for it; empty: it can, if its data are whole.
std::string pcx_fault(std::string_view pcx, const PcxLayout& l) {
  if (l.row * 8 < l.width * l.bits || !l.is_known()) return "its data are damaged";
  if (l.is_cga()) return "it is a PCX of the four colours of a CGA";
  const auto width = static_cast<std::int64_t>(l.width), height = static_cast<std::int64_t>(l.height);
  auto fault = image_size_fault(std::max(static_cast<std::int64_t>(l.row), width), height, pcx.size());
  if (fault.empty() && l.row * l.planes * l.height > pcx_most_of_byte * (pcx.size() - pcx_header))
    return "its " + std::to_string(pcx.size()) + " bytes cannot hold " + std::to_string(width) + " x " +
           std::to_string(height) + " pixels";
  return fault;
}

}  // namespace

bool decode_pcx(std::string_view pcx, Image& image, std::string& error) {
  const auto header = read_image_header(pcx);
  error = "its data are damaged";
  if (!header) return false;
  const PcxLayout l{static_cast<std::size_t>(header->width), static_cast<std::size_t>(header->height), pcx_byte(pcx, 3),
                    pcx_byte(pcx, 65), pcx_byte(pcx, 66) | pcx_byte(pcx, 67) << 8};
  error = pcx_fault(pcx, l);
  if (!error.empty()) return false;
  error = "its data are damaged";
  std::vector<std::uint8_t> rows(l.row * l.planes * l.height);
  if (!unpack_pcx(pcx.substr(pcx_header), pcx_byte(pcx, 2) == 1, rows)) return false;
  image = {header->width, header->height, header->channels, {}};
  image.pixels.reserve(l.width * l.height * static_cast<std::size_t>(header->channels));
  const std::string colors = l.has_colors() ? std::string() : pcx_colors(pcx, l);
  for (std::size_t y = 0; y < l.height; ++y)
    for (std::size_t x = 0; x < l.width; ++x) {
      const std::uint8_t* row = &rows[y * l.planes * l.row];
      const std::size_t index = l.has_colors() ? 0 : 3 * pcx_index(l, row, x);
      for (std::size_t c = 0; c < static_cast<std::size_t>(header->channels); ++c)
        image.pixels.push_back(l.has_colors() ? row[c * l.row + x] : static_cast<std::uint8_t>(colors[index + c]));
    }
  error.clear();
  return true;
}

}  // namespace wrlkit
