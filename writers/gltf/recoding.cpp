#include "writers/gltf/recoding.h"

#include <algorithm>
#include <cmath>

#include "writers/gltf/images.h"

namespace wrlkit::gltf {
namespace {

using Format = GltfTextures::Format;

constexpr std::string_view png = "image/png", jpeg = "image/jpeg", webp = "image/webp";

std::string_view target(const Image& image, PixelMeaning meaning, const PlainFile& plain, Format format) {
  const std::string_view kept = plain.mime == jpeg ? jpeg : png;
  if (format == Format::png) return png;
  if (format == Format::keep || meaning == PixelMeaning::data) return kept;
  if (format == Format::webp && image.channels >= 3) return webp;
  return alpha_of(image) == Alpha::opaque ? jpeg : kept;
}

std::optional<std::string> encoded(const Image& image, std::string_view mime, int quality, std::string& error) {
  if (mime == jpeg) return encode_jpeg(image, quality, error);
  if (mime == webp) return encode_webp(image, quality, error);
  return encode_png(image, error);
}

/// Between what is seen of both: where a picture is clear its colours do not count.
double psnr_of(const Image& a, const Image& b) {
  const auto n = static_cast<std::size_t>(a.channels), colors = n - (n % 2 == 0);
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); i += n)
    for (std::size_t c = 0; c < n; ++c) {
      const bool is_color = c < colors && colors < n;
      const double alpha_a = is_color ? a.pixels[i + colors] / 255.0 : 1,
                   alpha_b = is_color ? b.pixels[i + colors] / 255.0 : 1;
      const double d = a.pixels[i + c] * alpha_a - b.pixels[i + c] * alpha_b;
      sum += d * d;
    }
  constexpr double most = 99;  // dB: no difference that could be seen
  return sum > 0 ? std::min(most, 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.pixels.size()) / sum)) : most;
}

/// Few pixels of strong colours: what has a loss halves their resolution of colour, and is hardly smaller.
std::optional<std::string> lossless_instead(const Image& image, const Recoded& lossy, std::string& error) {
  constexpr double poor = 25;  // dB
  constexpr std::size_t times = 4, small = 1024;
  if (lossy.psnr >= poor) return std::nullopt;
  auto bytes = encode_png(image, error);
  return bytes && bytes->size() <= std::max(small, times * lossy.bytes.size()) ? std::move(bytes) : std::nullopt;
}

}  // namespace

bool may_recode(const GltfTextures& options, const PlainFile& plain, int width, int height) {
  const bool smaller = options.size > 0 && std::max(width, height) > options.size;
  const bool other = (options.format == Format::png && plain.mime != png) ||
                     (options.format == Format::jpeg && plain.mime != jpeg) || options.format == Format::webp;
  return plain.mime.empty() || smaller || other;
}

std::optional<Recoded> recoded(const Image& original, PixelMeaning meaning, const PlainFile& plain,
                               const GltfTextures& options, std::string& error) {
  const auto size = fitting_size(original, options.size);
  Recoded out{{}, target(original, meaning, plain, options.format), size != ImageSize{original.width, original.height}};
  if (out.mime == plain.mime && !out.resized) return std::nullopt;
  Image image = resized(original, size, meaning);
  const bool clear = alpha_of(image) != Alpha::opaque;
  const int channels = image.channels < 3 ? 1 : 3;
  if (out.mime == jpeg || (out.mime == webp && !clear)) image = with_channels(std::move(image), channels);
  auto bytes = encoded(image, out.mime, options.quality, error);
  if (!bytes) return std::nullopt;
  if (!plain.mime.empty() && !out.resized && options.format != Format::png && bytes->size() >= plain.bytes)
    return std::nullopt;
  out.bytes = std::move(*bytes);
  if (out.mime == png) return out;
  auto seen = decode_image(out.bytes, {}, error);
  if (!seen) return std::nullopt;
  out.psnr = psnr_of(image, with_channels(std::move(*seen), image.channels));
  auto exact = lossless_instead(image, out, error);
  if (!exact) return out;
  if (plain.mime == png && !out.resized) return std::nullopt;
  return Recoded{std::move(*exact), png, out.resized};
}

}  // namespace wrlkit::gltf
