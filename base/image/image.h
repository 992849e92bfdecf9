// Pictures: telling their type and size by their first bytes, decoding and encoding. PNG and JPEG are decoded by libpng
// and libjpeg-turbo (decode.h), and PNG is written here (png.h). All else is OpenImageIO's, which takes a third of a
// second to load: it is in a module of its own (image_module.h), opened when it is needed first.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

/// 8-bit pixels, top row first; 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA; display-referred (sRGB), alpha not multiplied
/// in. A palette counts as RGB even when all its colours are grey: the lighting model asks for the number of channels.
struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<std::uint8_t> pixels;
};

/// The same in linear light, as numbers of any size.
struct FloatImage {
  int width = 0, height = 0, channels = 0;
  std::vector<float> pixels;
};

struct ImageHeader {
  int width = 0, height = 0, channels = 0;  // as decode_image gives them
  bool alpha = false;
  std::string_view mime;
};

/// "image/png", "image/jpeg", "image/gif", "image/bmp", "image/tiff", "image/webp", "image/x-exr",
/// "image/vnd.radiance", "image/x-sgi", "image/vnd-ms.dds", "image/x-tga", by magic bytes; empty when it is none of
/// them. Most TGA files have no magic bytes: those are recognised by the extension of `name`, if their header makes
/// sense.
std::string_view sniff_mime(std::string_view bytes, std::string_view name = {});

/// Size and channels of a PNG, JPEG, GIF, BMP, SGI, DDS or TGA picture; nothing for other types and damaged headers.
/// The first 64 KiB are enough but for a JPEG with large metadata. O(1), or O(bytes before the first pixels).
std::optional<ImageHeader> read_image_header(std::string_view bytes, std::string_view name = {});

// Pictures beyond these are refused: a few bytes can claim to be a picture of any size. A large one must have at least
// a byte for every 10,000 of its pixels, which no codec but for plain colour gets below.
inline constexpr std::int64_t max_image_side = 65535, max_image_pixels = std::int64_t{1} << 28;
/// Why a picture of that size is not decoded; empty: it is.
std::string image_size_fault(std::int64_t width, std::int64_t height, std::size_t bytes);

/// Decodes PNG, JPEG, GIF (first picture of an animation), BMP, TGA, TIFF, WebP, EXR, HDR, SGI and DDS; 16-bit and
/// floating-point samples become 8-bit (linear ones through the sRGB curve, cut at 1), CMYK becomes RGB. Null, and why,
/// on failure.
std::optional<Image> decode_image(std::string_view bytes, std::string_view name, std::string& error);

/// The same bytes for the same picture: nothing but the pixels is written.
std::optional<std::string> encode_png(const Image&, std::string& error);
/// `quality` from 1 to 100. JPEG has no alpha; it is dropped.
std::optional<std::string> encode_jpeg(const Image&, int quality, std::string& error);
/// `quality` from 1 to 100; always with loss. Grey becomes RGB, for WebP has no grey.
std::optional<std::string> encode_webp(const Image&, int quality, std::string& error);
/// OpenEXR in half precision, which is 11 bits from 0.00006 to 65504, compressed without loss.
std::optional<std::string> encode_exr(const FloatImage&, std::string& error);
/// PNG, JPEG or WebP by the name's extension, the latter two at a quality at which no artefacts are seen. Null and no
/// error when the extension is none of them.
std::optional<std::string> encode_as(std::string_view name, const Image&, std::string& error);
/// Whether encode_as knows the extension.
bool can_encode_as(std::string_view name);

/// The picture with 1 to 4 channels: alpha is dropped or opaque, grey is spread or the red channel.
Image with_channels(Image, int channels);

}  // namespace wrlkit
