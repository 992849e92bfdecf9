#include <turbojpeg.h>

#include <memory>

#include "base/image/decode.h"

namespace wrlkit {
namespace {

struct End {
  void operator()(void* reader) const { tjDestroy(reader); }
};
using Reader = std::unique_ptr<void, End>;

struct Header {
  int width = 0, height = 0, sampling = 0, colors = TJCS_CMYK;
};

/// Nothing when there is no header, or no memory for a reader.
bool read_header(const Reader& reader, std::string_view jpeg, Header& h) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(jpeg.data());
  return reader &&
         tjDecompressHeader3(reader.get(), bytes, jpeg.size(), &h.width, &h.height, &h.sampling, &h.colors) == 0;
}

}  // namespace

bool is_plain_jpeg(std::string_view jpeg) {
  Header h;
  return read_header(Reader(tjInitDecompress()), jpeg, h) && h.colors != TJCS_CMYK && h.colors != TJCS_YCCK;
}

bool decode_jpeg(std::string_view jpeg, Image& image, std::string& error) {
  const Reader reader(tjInitDecompress());
  Header h;
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
  if (tjDecompress2(reader.get(), bytes, jpeg.size(), image.pixels.data(), h.width, 0, h.height, format,
                    TJFLAG_LIMITSCANS) == 0 ||
      tjGetErrorCode(reader.get()) == TJERR_WARNING)
    return true;
  error = tjGetErrorStr2(reader.get());
  return false;
}

}  // namespace wrlkit
