// Picture codecs by OpenImageIO, as a module that base/image/image.cpp opens. Everything goes through memory; nothing
// is guessed from names, and only the codecs that are asked for by name ever see the bytes.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "base/image/image_module.h"

namespace {

using wrlkit::DecodeRequest;
using wrlkit::Image;

/// Channels that are used: colours, and alpha where it follows them. The reader of GIF gets the number of its alpha
/// channel wrong, but not its name.
int used_channels(const OIIO::ImageSpec& spec) {
  int n = std::min(spec.nchannels, 4);
  bool alpha = n % 2 == 0 && (spec.alpha_channel == n - 1 || spec.channel_name(n - 1) == "A");
  return n % 2 == 0 && !alpha ? n - 1 : n;
}

/// IEC 61966-2-1, 4.3: linear light to 8-bit sRGB.
std::uint8_t srgb(float linear) {
  float v = linear > 0 ? std::min(linear, 1.0f) : 0.0f;  // NaN is black
  v = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(v * 255 + 0.5f);
}

bool read_linear(OIIO::ImageInput& in, Image& image) {
  std::vector<float> linear(image.pixels.size());
  if (!in.read_image(0, 0, 0, image.channels, OIIO::TypeFloat, linear.data())) return false;
  for (std::size_t i = 0; i < linear.size(); i += image.channels) {
    bool alpha = image.channels % 2 == 0;
    int colours = image.channels - alpha;
    float a = alpha ? std::clamp(linear[i + colours], 0.0f, 1.0f) : 1.0f;
    // The colours of floating-point pictures are multiplied by alpha.
    for (int c = 0; c < colours; ++c) image.pixels[i + c] = srgb(a > 0 ? linear[i + c] / a : linear[i + c]);
    if (alpha) image.pixels[i + colours] = static_cast<std::uint8_t>(a * 255 + 0.5f);
  }
  return true;
}

bool read_pixels(OIIO::ImageInput& in, const DecodeRequest& from, Image& image, std::string& error) {
  auto& spec = in.spec();
  error = from.size_fault(spec.width, spec.height, from.bytes.size());
  if (!error.empty()) return false;
  image.width = spec.width;
  image.height = spec.height;
  image.channels = used_channels(spec);
  image.pixels.resize(std::size_t(image.width) * image.height * image.channels);
  if (spec.format.is_floating_point()) return read_linear(in, image);
  return in.read_image(0, 0, 0, image.channels, OIIO::TypeUInt8, image.pixels.data());
}

bool decode(const DecodeRequest& from, Image& image, std::string& error) try {
  auto in = OIIO::ImageInput::create(from.codec);
  if (!in) {
    error = "OpenImageIO cannot read this type";
    return false;
  }
  OIIO::Filesystem::IOMemReader memory(from.bytes.data(), from.bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &memory;
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("bmp:monochrome_detect", 0);
  bool done = in->open(from.codec, spec, config) && read_pixels(*in, from, image, error);
  if (!done && error.empty()) error = in->geterror();
  if (!done && error.empty()) error = "its data are damaged";
  in->close();
  return done;
} catch (const std::exception& e) {
  error = e.what();
  return false;
}

bool write(const char* codec, OIIO::ImageSpec spec, const OIIO::TypeDesc& type, const void* pixels, std::string& bytes,
           std::string& error) try {
  auto out = OIIO::ImageOutput::create(codec);
  if (!out) {
    error = "OpenImageIO cannot write this type";
    return false;
  }
  OIIO::Filesystem::IOVecOutput memory;
  OIIO::Filesystem::IOProxy* proxy = &memory;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  if (spec.nchannels == 2) spec.alpha_channel = 1;
  bool done = out->open(codec, spec) && out->write_image(type, pixels) && out->close();
  if (!done) error = out->geterror();
  bytes.assign(memory.buffer().begin(), memory.buffer().end());
  return done;
} catch (const std::exception& e) {
  error = e.what();
  return false;
}

bool encode(const Image& image, const char* codec, int quality, std::string& bytes, std::string& error) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeUInt8);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  if (quality > 0) spec.attribute("CompressionQuality", quality);
  return write(codec, spec, OIIO::TypeUInt8, image.pixels.data(), bytes, error);
}

bool encode_exr(const wrlkit::FloatImage& image, std::string& bytes, std::string& error) {
  OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeHalf);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "1970:01:01 00:00:00");  // else it is now, and the same picture has other bytes
  return write("openexr", spec, OIIO::TypeFloat, image.pixels.data(), bytes, error);
}

}  // namespace

extern "C" const wrlkit::ImageModule* wrlkit_images() {
  static const wrlkit::ImageModule module = [] {
    OIIO::attribute("threads", 1);  // pictures are decoded in parallel by the caller, if at all
    OIIO::attribute("exr_threads", -1);
#ifdef WRLKIT_WEBPMUX
    return wrlkit::ImageModule{decode, encode, encode_exr, wrlkit_begin_webp_animation};
#else
    return wrlkit::ImageModule{decode, encode, encode_exr, nullptr};
#endif
  }();
  return &module;
}
