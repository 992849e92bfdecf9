// Types and sizes of pictures, from their first bytes.
#include <algorithm>
#include <utility>

#include "base/image/image.h"
#include "base/image/xbm.h"
#include "base/text/letter_case.h"

namespace wrlkit {
namespace {

using namespace std::string_view_literals;

/// Bytes with numbers at offsets; what lies behind the end reads as 0.
struct Bytes {
  std::string_view b;
  std::uint32_t u8(std::size_t i) const { return i < b.size() ? static_cast<unsigned char>(b[i]) : 0; }
  std::uint32_t le16(std::size_t i) const { return u8(i) | u8(i + 1) << 8; }
  std::uint32_t le32(std::size_t i) const { return le16(i) | le16(i + 2) << 16; }
  std::uint32_t be16(std::size_t i) const { return u8(i) << 8 | u8(i + 1); }
  std::uint32_t be32(std::size_t i) const { return be16(i) << 16 | be16(i + 2); }
  bool is(std::size_t i, std::string_view s) const { return i < b.size() && b.substr(i, s.size()) == s; }
};

using Header = std::optional<ImageHeader>;

Header header(std::uint32_t width, std::uint32_t height, int channels, std::string_view mime) {
  if (width == 0 || height == 0 || width > 0x7fffffff || height > 0x7fffffff) return std::nullopt;
  return ImageHeader{static_cast<int>(width), static_cast<int>(height), channels, channels % 2 == 0, mime};
}

// PNG (ISO/IEC 15948): IHDR is the first chunk; a tRNS chunk before the first IDAT adds alpha.
Header png(Bytes f) {
  constexpr int channels_of_type[] = {1, 0, 3, 3, 2, 0, 4};
  if (!f.is(12, "IHDR") || f.u8(25) > 6 || channels_of_type[f.u8(25)] == 0) return std::nullopt;
  int channels = channels_of_type[f.u8(25)];
  for (std::size_t at = 8; at + 8 <= f.b.size() && !f.is(at + 4, "IDAT"); at += std::size_t{12} + f.be32(at))
    if (f.is(at + 4, "tRNS") && channels % 2 == 1) ++channels;
  return header(f.be32(16), f.be32(20), channels, "image/png");
}

// JPEG (ISO/IEC 10918-1, annex B): the first start-of-frame marker; 0xc4, 0xc8 and 0xcc among them mean other things.
Header jpeg(Bytes f) {
  for (std::size_t at = 2; at + 4 <= f.b.size();) {
    auto marker = f.u8(at + 1);
    if (f.u8(at) != 0xff) return std::nullopt;
    if (marker == 0xff)
      ++at;  // padding
    else if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd8))
      at += 2;  // markers without a length
    else if (marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc)
      return header(f.be16(at + 7), f.be16(at + 5), f.u8(at + 9) == 1 ? 1 : 3, "image/jpeg");
    else
      at += std::size_t{2} + std::max(2u, f.be16(at + 2));
  }
  return std::nullopt;
}

// GIF89a: the size of the whole, then blocks up to the first picture. It has alpha when one of the colours is
// transparent or when it does not cover the whole.
Header gif(Bytes f) {
  auto table = [&](std::size_t flags) { return f.u8(flags) & 0x80 ? std::size_t{3} << ((f.u8(flags) & 7) + 1) : 0; };
  auto width = f.le16(6), height = f.le16(8);
  bool alpha = false;
  for (std::size_t at = 13 + table(10); at < f.b.size();) {
    if (f.u8(at) == 0x2c) {
      alpha |= f.le16(at + 1) > 0 || f.le16(at + 3) > 0 || f.le16(at + 5) < width || f.le16(at + 7) < height;
      return header(width, height, alpha ? 4 : 3, "image/gif");
    }
    if (f.u8(at) != 0x21) return std::nullopt;
    if (f.u8(at + 1) == 0xf9) alpha = f.u8(at + 3) & 1;
    for (at += 2; f.u8(at) != 0;) at += f.u8(at) + 1;
    ++at;
  }
  return std::nullopt;
}

// BMP: OS/2 headers have 12 bytes, Windows' 40 and more; a negative height means top row first. Only headers with an
// alpha mask (56 bytes and more) have alpha; otherwise the fourth byte of a pixel is padding.
Header bmp(Bytes f) {
  auto size = f.le32(14);
  if (size == 12) return header(f.le16(18), f.le16(20), 3, "image/bmp");
  if (size < 40) return std::nullopt;
  auto height = static_cast<std::int32_t>(f.le32(22));
  bool alpha = size >= 56 && f.le16(28) == 32 && f.le32(66) != 0;
  return header(f.le32(18), height < 0 ? 0u - static_cast<std::uint32_t>(height) : height, alpha ? 4 : 3, "image/bmp");
}

// TGA: types 1, 2, 3 are palette, colour, grey; 8 more when run-length encoded. The low bits of the descriptor say how
// many bits of a pixel are alpha.
Header tga(Bytes f) {
  auto palette = f.u8(1), type = f.u8(2) & ~8u, bits = f.u8(16), palette_bits = f.u8(7);
  bool alpha = (f.u8(17) & 15) != 0;
  if (f.b.size() < 18 || palette > 1 || type < 1 || type > 3 || (f.u8(2) & ~15u) || (palette == 0) == (type == 1))
    return std::nullopt;
  if (bits != 8 && bits != 15 && bits != 16 && bits != 24 && bits != 32) return std::nullopt;
  if (type == 3)
    alpha = bits == 16;
  else if (type == 1)
    alpha = palette_bits == 32;
  else
    alpha = alpha && (bits == 16 || bits == 32);
  int channels = (type == 3 ? 1 : 3) + alpha;
  return header(f.le16(12), f.le16(14), channels, "image/x-tga");
}

// SGI: whether it is run-length encoded, bytes a sample, dimensions, width, height, channels. Of more than four
// channels the first four count.
Header sgi(Bytes f) {
  const auto dimensions = f.be16(4), channels = dimensions > 2 ? f.be16(10) : 1;
  if (f.u8(2) > 1 || dimensions < 1 || dimensions > 3 || channels < 1) return std::nullopt;
  return header(f.be16(6), dimensions > 1 ? f.be16(8) : 1, static_cast<int>(std::min(channels, 4u)), "image/x-sgi");
}

// DDS_HEADER: height, width.
Header dds(Bytes f) { return header(f.le32(16), f.le32(12), 4, "image/vnd-ms.dds"); }

// PCX: its first byte alone says little, so that the fields that follow have to fit as well.
Header pcx(Bytes f) {
  const auto bits = f.u8(3), planes = f.u8(65);
  if (f.b.size() < 128 || f.u8(1) > 5 || f.u8(2) > 1 || planes < 1 || planes > 4) return std::nullopt;
  if ((bits != 1 && bits != 2 && bits != 4 && bits != 8) || f.le16(8) < f.le16(4) || f.le16(10) < f.le16(6))
    return std::nullopt;
  return header(f.le16(8) - f.le16(4) + 1, f.le16(10) - f.le16(6) + 1, bits == 8 && planes == 4 ? 4 : 3, "image/x-pcx");
}

bool is_pcx(std::string_view bytes) { return bytes.starts_with('\x0a') && pcx({bytes}); }

Header xbm(std::string_view bytes) {
  const auto size = xbm_size(bytes);
  return size ? Header(ImageHeader{size->width, size->height, 1, false, "image/x-xbitmap"}) : std::nullopt;
}

struct Magic {
  std::string_view bytes;
  std::size_t at;
  std::string_view mime;
  Header (*read)(Bytes);
};

constexpr Magic magics[] = {
    {"\x89PNG\r\n\x1a\n"sv, 0, "image/png", png},
    {"\xff\xd8\xff"sv, 0, "image/jpeg", jpeg},
    {"GIF87a"sv, 0, "image/gif", gif},
    {"GIF89a"sv, 0, "image/gif", gif},
    {"BM"sv, 0, "image/bmp", bmp},
    {"II*\0"sv, 0, "image/tiff", nullptr},
    {"MM\0*"sv, 0, "image/tiff", nullptr},
    {"WEBP"sv, 8, "image/webp", nullptr},
    {"\x76\x2f\x31\x01"sv, 0, "image/x-exr", nullptr},
    {"#?RADIANCE"sv, 0, "image/vnd.radiance", nullptr},
    {"#?RGBE"sv, 0, "image/vnd.radiance", nullptr},
    {"\x01\xda"sv, 0, "image/x-sgi", sgi},
    {"DDS |"sv, 0, "image/vnd-ms.dds", dds},
};

bool is_tga(std::string_view bytes, std::string_view name) {
  constexpr auto footer = "TRUEVISION-XFILE.\0"sv;
  if (bytes.ends_with(footer)) return true;
  return ends_with_ignoring_case(name, ".tga") && tga({bytes});
}

const Magic* find_magic(std::string_view bytes) {
  for (auto& m : magics)
    if (Bytes{bytes}.is(m.at, m.bytes)) return &m;
  return nullptr;
}

}  // namespace

std::string_view sniff_mime(std::string_view bytes, std::string_view name) {
  if (auto* m = find_magic(bytes)) return m->mime;
  if (is_pcx(bytes)) return "image/x-pcx";
  if (xbm(bytes)) return "image/x-xbitmap";
  return is_tga(bytes, name) ? "image/x-tga"sv : ""sv;
}

std::optional<ImageHeader> read_image_header(std::string_view bytes, std::string_view name) {
  if (auto* m = find_magic(bytes)) return m->read ? m->read({bytes}) : std::nullopt;
  if (is_pcx(bytes)) return pcx({bytes});
  if (const auto found = xbm(bytes)) return found;
  return is_tga(bytes, name) ? tga({bytes}) : std::nullopt;
}

std::string image_size_fault(std::int64_t width, std::int64_t height, std::size_t bytes) {
  constexpr std::int64_t small = 4 << 20, pixels_per_byte = 10'000;
  auto size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width <= 0 || height <= 0) return "it has no pixels";
  if (width > max_image_side || height > max_image_side || width * height > max_image_pixels)
    return size + " are too many";
  if (width * height > small && std::cmp_greater(width * height / pixels_per_byte, bytes))
    return "its " + std::to_string(bytes) + " bytes cannot hold " + size;
  return {};
}

}  // namespace wrlkit
