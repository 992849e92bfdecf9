#include "scenegraph/png.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace wrlkit {
namespace {

constexpr auto crc_table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}();

std::uint32_t crc(std::string_view s) {
  std::uint32_t c = ~0u;
  for (unsigned char b : s) c = crc_table[(c ^ b) & 0xff] ^ (c >> 8);
  return ~c;
}

std::uint32_t big_endian(std::string_view s) {
  std::uint32_t v = 0;
  for (unsigned char b : s.substr(0, 4)) v = v << 8 | b;
  return v;
}

}  // namespace

std::optional<std::string> essential_png(std::string_view png) {
  constexpr std::string_view kept[] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  constexpr std::size_t signature = 8, frame = 12;  // length, type and sum around the data of a chunk
  std::string out(png.substr(0, signature));
  bool has_pixels = false;
  for (std::size_t at = signature; png.size() >= at + frame;) {
    std::size_t length = big_endian(png.substr(at));
    if (length > png.size() - at - frame) return std::nullopt;
    auto chunk = png.substr(at, length + frame), type = chunk.substr(4, 4);
    at += chunk.size();
    if (std::ranges::find(kept, type) == std::end(kept)) continue;
    if (crc(chunk.substr(4, length + 4)) != big_endian(chunk.substr(length + 8))) return std::nullopt;
    if ((out.size() == signature) != (type == "IHDR")) return std::nullopt;
    out += chunk;
    has_pixels |= type == "IDAT";
    if (type == "IEND") return has_pixels ? std::optional(out) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace wrlkit
