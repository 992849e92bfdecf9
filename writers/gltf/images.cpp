#include "writers/gltf/images.h"

#include "base/image/png.h"

namespace wrlkit::gltf {
namespace {

using namespace std::string_view_literals;

std::uint32_t big_endian(std::string_view s, int n) {
  std::uint32_t v = 0;
  for (int i = 0; i < n; ++i) v = v << 8 | static_cast<unsigned char>(s[static_cast<std::size_t>(i)]);
  return v;
}

constexpr std::string_view png_magic = "\x89PNG\r\n\x1a\n";

/// Does a chunk ask for anything but square pixels in sRGB?
bool unusual(std::string_view name, std::string_view data) {
  constexpr std::string_view srgb_primaries =
      "\0\0\x7a\x26\0\0\x80\x84\0\0\xfa\0\0\0\x80\xe8"
      "\0\0\x75\x30\0\0\xea\x60\0\0\x3a\x98\0\0\x17\x70"sv;
  constexpr std::string_view srgb_gamma = "\0\0\xb1\x8f"sv;
  if (name == "iCCP") return true;
  if (name == "gAMA") return data != srgb_gamma;
  if (name == "cHRM") return data != srgb_primaries;
  if (name == "pHYs") return data.size() != 9 || data.substr(0, 4) != data.substr(4, 4);
  return name == "sRGB" && data.size() != 1;
}

PortableImage portable_png(std::string_view bytes) {
  if (!bytes.starts_with(png_magic)) return {};
  bool pixels = false, good = true;
  for (auto rest = bytes.substr(png_magic.size()); !rest.empty();) {
    constexpr std::size_t frame = 12;  // length, name, checksum
    if (rest.size() < frame || rest.size() - frame < big_endian(rest, 4)) return {};
    auto data = rest.substr(8, big_endian(rest, 4)), name = rest.substr(4, 4);
    rest.remove_prefix(data.size() + frame);
    if (unusual(name, data)) good = false;
    pixels |= name == "IDAT";
    if (name == "IEND") break;
  }
  if (!pixels || good) return {pixels, {}};
  auto cleaned = essential_png(bytes);
  return {cleaned.has_value(), std::move(cleaned)};
}

PortableImage portable_jpeg(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 10 <= bytes.size() && bytes[at] == '\xff') {
    auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xff) {
      ++at;
      continue;
    }  // fill byte
    bool stands_alone = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8);
    bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame) return {bytes[at + 9] == 1 || bytes[at + 9] == 3, {}};
    at += stands_alone ? 2 : 2 + big_endian(bytes.substr(at + 2), 2);
  }
  return {};
}

}  // namespace

PortableImage portable_image(std::string_view bytes, std::string_view mime) {
  if (mime == "image/png") return portable_png(bytes);
  if (mime == "image/jpeg") return portable_jpeg(bytes);
  return {};
}

Alpha alpha_of(const Image& image) {
  if (image.channels != 2 && image.channels != 4) return Alpha::opaque;
  bool clear = false;
  const auto step = static_cast<std::size_t>(image.channels);
  for (std::size_t i = step - 1; i < image.pixels.size(); i += step) {
    if (image.pixels[i] == 255) continue;
    if (image.pixels[i] != 0) return Alpha::blend;
    clear = true;
  }
  return clear ? Alpha::mask : Alpha::opaque;
}

}  // namespace wrlkit::gltf
