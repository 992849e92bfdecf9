// What must hold of any bytes as a picture: the header, whatever the name of the file says, and the pixels of PNG and
// JPEG, which our own path decodes. A picture has the size that its header says, and is written as PNG and read back as
// the same.
#include "base/image/image.h"
#include "tests/fuzz/harness.h"

using namespace wrlkit;

namespace {

constexpr std::int64_t most_pixels = 1 << 20;  // so that one picture takes no seconds

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = text_of(data, size);
  for (const char* name : {"a.png", "a.tga", "a.jpg", ""}) {
    sniff_mime(bytes, name);
    if (const auto header = read_image_header(bytes, name))
      require(header->width > 0 && header->height > 0 && header->channels >= 1 && header->channels <= 4,
              "a header without a size");
  }
  const auto mime = sniff_mime(bytes);
  const auto header = read_image_header(bytes);
  if (!header || (mime != "image/png" && mime != "image/jpeg")) return 0;
  if (std::int64_t{header->width} * header->height > most_pixels) return 0;
  std::string why;
  const auto image = decode_image(bytes, "fuzz", why);
  require(image.has_value() == why.empty(), "neither a picture nor why not, or both");
  if (!image) return 0;
  require(image->width == header->width && image->height == header->height && image->channels == header->channels,
          "another picture than the header says");
  require(image->pixels.size() == std::size_t(image->width) * std::size_t(image->height) * std::size_t(image->channels),
          "pixels are missing");
  const auto png = encode_png(*image, why);
  require(png.has_value(), "not written: " + why);
  const auto again = decode_image(*png, "again", why);
  require(again && again->pixels == image->pixels, "what was written is another picture");
  return 0;
}
