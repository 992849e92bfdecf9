// What the module with the picture codecs (base/image/image_oiio.cpp, image_webp_animation.cpp) offers to
// base/image/image.cpp, which opens it.
#pragma once
#include <string>
#include <string_view>

#include "base/image/image.h"
#include "base/image/image_animation.h"

namespace wrlkit {

struct DecodeRequest {
  std::string_view bytes;
  const char* codec;  // OpenImageIO's name
  decltype(&image_size_fault) size_fault;
};

struct ImageModule {
  /// Pixels of the first picture, with the channels that the codec gives.
  bool (*decode)(const DecodeRequest&, Image&, std::string& error);
  bool (*encode)(const Image&, const char* codec, int quality, std::string& bytes, std::string& error);
  bool (*encode_exr)(const FloatImage&, std::string& bytes, std::string& error);
  std::unique_ptr<PictureAnimation> (*begin_webp_animation)(int milliseconds, int quality);  // null without libwebpmux
};

}  // namespace wrlkit

extern "C" const wrlkit::ImageModule* wrlkit_images();
/// Within the module (base/image/image_webp_animation.cpp).
std::unique_ptr<wrlkit::PictureAnimation> wrlkit_begin_webp_animation(int milliseconds, int quality);
