#include <png.h>

#include "base/image/decode.h"
#include "base/image/png.h"
#include "base/lazy_library.h"

namespace wrlkit {
namespace {

/// libpng, which is opened for the first picture.
struct Png {
  decltype(&::png_image_begin_read_from_memory) begin = nullptr;
  decltype(&::png_image_finish_read) finish = nullptr;
  decltype(&::png_image_free) free = nullptr;
  std::string fault;
};

Png open_png() {
  Png out;
  LazyLibrary library("libpng16.so.16");
  library.find(out.begin, "png_image_begin_read_from_memory");
  library.find(out.finish, "png_image_finish_read");
  library.find(out.free, "png_image_free");
  out.fault = library.fault();
  return out;
}

const Png& opened_png() {
  static const Png png = open_png();
  return png;
}

/// libpng's reader of whole pictures, which neither prints nor jumps.
class PngReader {
 public:
  explicit PngReader(std::string_view png) { good_ = opened_png().begin(&image_, png.data(), png.size()) != 0; }
  ~PngReader() { opened_png().free(&image_); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool is_good() const { return good_; }
  std::string fault() const { return image_.message; }
  png_image& image() { return image_; }

 private:
  png_image image_{.version = PNG_IMAGE_VERSION};
  bool good_ = false;
};

}  // namespace

bool decode_png(std::string_view bytes, Image& image, std::string& error) {
  const auto header = read_image_header(bytes);
  const auto png = header ? essential_png(bytes) : std::nullopt;
  if (!png) {
    error = "its data are damaged";
    return false;
  }
  error = opened_png().fault;
  if (!error.empty()) return false;
  constexpr png_uint_32 formats[] = {PNG_FORMAT_GRAY, PNG_FORMAT_GA, PNG_FORMAT_RGB, PNG_FORMAT_RGBA};
  PngReader reader(*png);
  auto& source = reader.image();
  source.format = formats[header->channels - 1];
  source.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // 16 bits are finer steps of the same curve
  image = {header->width, header->height, header->channels, {}};
  image.pixels.resize(std::size_t(image.width) * image.height * image.channels);
  if (reader.is_good() && opened_png().finish(&source, nullptr, image.pixels.data(), 0, nullptr) != 0) return true;
  error = reader.fault();
  return false;
}

}  // namespace wrlkit
