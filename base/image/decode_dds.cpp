// DirectDraw surfaces in blocks of 4 x 4 texels: Microsoft's "Programming Guide for DDS" (DDS_HEADER) and "Block
// Compression". A decoder of our own, because that of OpenImageIO 2.4 divides by zero and writes beyond its memory
// where a header is damaged.
#include <algorithm>
#include <array>
#include <cstdint>

#include "base/image/decode.h"
#include "base/image/decode_bc7.h"

namespace wrlkit {
namespace {

std::uint64_t le(std::string_view b, std::size_t at, std::size_t bytes) {
  std::uint64_t v = 0;
  for (std::size_t i = bytes; i-- > 0;) v = v << 8 | static_cast<unsigned char>(b[at + i]);
  return v;
}

Texel of_565(std::uint64_t v) {
  const auto r = v >> 11 & 31, g = v >> 5 & 63, b = v & 31;
  return {static_cast<std::uint8_t>(r << 3 | r >> 2), static_cast<std::uint8_t>(g << 2 | g >> 4),
          static_cast<std::uint8_t>(b << 3 | b >> 2), 255};
}

Texel mixed(const Texel& a, const Texel& b, int parts_of_a, int parts) {
  Texel out{};
  for (std::size_t i = 0; i < 4; ++i)
    out[i] = static_cast<std::uint8_t>((parts_of_a * a[i] + (parts - parts_of_a) * b[i]) / parts);
  return out;
}

/// `may_be_clear`: of BC1, whose fourth colour is transparent black where the first colour is not the larger one.
void colors(std::string_view block, bool may_be_clear, TexelBlock& to) {
  const auto first = le(block, 0, 2), second = le(block, 2, 2), index = le(block, 4, 4);
  const Texel a = of_565(first), b = of_565(second);
  const bool clear = may_be_clear && first <= second;
  const Texel palette[]{a, b, clear ? mixed(a, b, 1, 2) : mixed(a, b, 2, 3), clear ? Texel{} : mixed(a, b, 1, 3)};
  for (std::size_t i = 0; i < 16; ++i) to[i] = palette[index >> 2 * i & 3];
}

void alphas_of_bc2(std::string_view block, TexelBlock& to) {
  const auto alphas = le(block, 0, 8);
  for (std::size_t i = 0; i < 16; ++i) to[i][3] = static_cast<std::uint8_t>((alphas >> 4 * i & 15) * 17);
}

/// One channel by itself: the alpha of BC3, red of BC4, red and green of BC5.
void channel(std::string_view block, std::size_t which, TexelBlock& to) {
  const auto first = le(block, 0, 1), second = le(block, 1, 1), index = le(block, 2, 6);
  std::array<std::uint64_t, 8> palette{first, second, 0, 0, 0, 0, 0, 255};
  const std::uint64_t steps = first > second ? 7 : 5;
  for (std::uint64_t i = 1; i < steps; ++i) palette[i + 1] = ((steps - i) * first + i * second) / steps;
  for (std::size_t i = 0; i < 16; ++i) to[i][which] = static_cast<std::uint8_t>(palette[index >> 3 * i & 7]);
}

enum class Coding : std::uint8_t { none, bc1, bc2, bc3, bc4, bc5, bc7 };

struct Layout {
  Coding coding = Coding::none;
  std::size_t header = 128;
};

/// By the four letters of the header, or by the DXGI_FORMAT of the one behind it: three of them for each coding, of
/// BC4 and BC5 the last one with signed values.
Layout layout_of(std::string_view dds) {
  constexpr std::size_t header = 128, header_of_dx10 = 20;
  constexpr std::uint64_t by_four_cc = 4;
  using enum Coding;
  struct Name {
    std::string_view letters;
    Coding coding;
  };
  static constexpr Name names[] = {{"DXT1", bc1}, {"DXT3", bc2}, {"DXT5", bc3}, {"ATI1", bc4},
                                   {"BC4U", bc4}, {"ATI2", bc5}, {"BC5U", bc5}};
  if (dds.size() < header || le(dds, 80, 4) != by_four_cc) return {};
  for (const auto& [letters, coding] : names)
    if (dds.substr(84, 4) == letters) return {coding, header};
  if (dds.substr(84, 4) != "DX10" || dds.size() < header + header_of_dx10) return {};
  constexpr std::uint64_t plane = 3, cube = 4, typeless_bc1 = 70, typeless_bc7 = 97, per_coding = 3;
  const auto format = le(dds, header, 4) - typeless_bc1;
  if ((le(dds, header + 8, 4) & cube) != 0) return {};
  if (le(dds, header + 4, 4) != plane || le(dds, header + 12, 4) != 1) return {};
  if (format - (typeless_bc7 - typeless_bc1) < per_coding) return {bc7, header + header_of_dx10};
  if (format >= 5 * per_coding) return {};
  const auto coding = static_cast<Coding>(1 + format / per_coding);
  const bool is_signed = coding >= bc4 && format % per_coding == 2;
  return {is_signed ? none : coding, header + header_of_dx10};
}

void decode_block(Coding coding, std::string_view block, TexelBlock& to) {
  if (coding == Coding::bc7) return decode_bc7(block, to);
  if (coding >= Coding::bc4) {
    to.fill({0, 0, 0, 255});
    channel(block, 0, to);
    if (coding == Coding::bc5) return channel(block.substr(8), 1, to);
    for (Texel& t : to) t[1] = t[2] = t[0];
    return;
  }
  colors(block.substr(block.size() - 8), coding == Coding::bc1, to);
  if (coding == Coding::bc2) alphas_of_bc2(block, to);
  if (coding == Coding::bc3) channel(block, 3, to);
}

}  // namespace

bool decode_dds(std::string_view dds, Image& image, std::string& error) {
  const auto [coding, header] = layout_of(dds);
  error = "it is not a DDS of BC1 to BC5 or BC7 in one layer";
  if (coding == Coding::none || le(dds, 24, 4) > 1 || le(dds, 112, 4) != 0) return false;  // a volume, a cube
  const auto height = le(dds, 12, 4), width = le(dds, 16, 4);
  error = image_size_fault(static_cast<std::int64_t>(width), static_cast<std::int64_t>(height), dds.size());
  if (!error.empty()) return false;
  const std::size_t columns = (width + 3) / 4, rows = (height + 3) / 4,
                    bytes = coding == Coding::bc1 || coding == Coding::bc4 ? 8 : 16;
  error = "its data are damaged";
  if (width == 0 || height == 0 || header + columns * rows * bytes > dds.size()) return false;
  image = {static_cast<int>(width), static_cast<int>(height), 4, {}};
  image.pixels.resize(width * height * 4);
  TexelBlock texels;
  for (std::size_t at = 0; at < columns * rows; ++at) {
    decode_block(coding, dds.substr(header + at * bytes, bytes), texels);
    const std::size_t x = at % columns * 4, y = at / columns * 4;
    for (std::size_t i = 0; i < 16; ++i)
      if (x + i % 4 < width && y + i / 4 < height)
        std::ranges::copy(texels[i], &image.pixels[((y + i / 4) * width + x + i % 4) * 4]);
  }
  error.clear();
  return true;
}

}  // namespace wrlkit
