#include <turbojpeg.h>

#include <memory>

#include "base/image/decode.h"
#include "base/lazy_library.h"

namespace wrlkit {
namespace {

/// libjpeg-turbo, which is opened for the first picture.
struct Jpeg {
  decltype(&::tjInitDecompress) begin = nullptr;
  decltype(&::tjDestroy) end = nullptr;
  decltype(&::tjDecompressHeader3) header = nullptr;
  decltype(&::tjDecompress2) pixels = nullptr;
  decltype(&::tjGetErrorCode) severity = nullptr;
  decltype(&::tjGetErrorStr2) message = nullptr;
  std::string fault;
};

Jpeg open_jpeg() {
  Jpeg out;
  LazyLibrary library("libturbojpeg.so.0");
  library.find(out.begin, "tjInitDecompress");
  library.find(out.end, "tjDestroy");
  library.find(out.header, "tjDecompressHeader3");
  library.find(out.pixels, "tjDecompress2");
  library.find(out.severity, "tjGetErrorCode");
  library.find(out.message, "tjGetErrorStr2");
  out.fault = library.fault();
  return out;
}

const Jpeg& opened_jpeg() {
  static const Jpeg jpeg = open_jpeg();
  return jpeg;
}

struct EndJpeg {
  void operator()(void* reader) const { opened_jpeg().end(reader); }
};
using JpegReader = std::unique_ptr<void, EndJpeg>;

/// Null without the library, or without memory for it.
JpegReader new_reader() {
  const Jpeg& jpeg = opened_jpeg();
  return JpegReader(jpeg.fault.empty() ? jpeg.begin() : nullptr);
}

struct JpegHeader {
  int width = 0, height = 0, sampling = 0, colors = TJCS_CMYK;
};

/// Nothing when there is no header, or no memory for a reader.
bool read_header(const JpegReader& reader, std::string_view jpeg, JpegHeader& h) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  return reader &&
         opened_jpeg().header(reader.get(), bytes, jpeg.size(), &h.width, &h.height, &h.sampling, &h.colors) == 0;
}

}  // namespace

bool is_plain_jpeg(std::string_view jpeg) {
  JpegHeader h;
  return read_header(new_reader(), jpeg, h) && h.colors != TJCS_CMYK && h.colors != TJCS_YCCK;
}

bool decode_jpeg(std::string_view jpeg, Image& image, std::string& error) {
  const JpegReader reader = new_reader();
  JpegHeader h;
  if (!read_header(reader, jpeg, h)) {
    error = "its data are damaged";
    return false;
  }
  error = image_size_fault(h.width, h.height, jpeg.size());
  if (!error.empty()) return false;
  const bool grey = h.colors == TJCS_GRAY;
  image = {h.width, h.height, grey ? 1 : 3, {}};
  image.pixels.resize(std::size_t(h.width) * h.height * image.channels);
  const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  const int format = grey ? TJPF_GRAY : TJPF_RGB;
  if (opened_jpeg().pixels(reader.get(), bytes, jpeg.size(), image.pixels.data(), h.width, 0, h.height, format,
                           TJFLAG_LIMITSCANS) == 0 ||
      opened_jpeg().severity(reader.get()) == TJERR_WARNING)
    return true;
  error = opened_jpeg().message(reader.get());
  return false;
}

}  // namespace wrlkit
