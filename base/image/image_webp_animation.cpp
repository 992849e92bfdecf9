// Animated WebP by libwebpmux, in the module with the picture codecs: OpenImageIO reads animations, but writes none.
#include <webp/encode.h>
#include <webp/mux.h>

#include "base/image/image_module.h"

namespace {

using wrlkit::Image;

class Animation final : public wrlkit::PictureAnimation {
 public:
  Animation(int milliseconds, int quality) : milliseconds_(milliseconds), quality_(quality) {}
  ~Animation() override { WebPAnimEncoderDelete(encoder_); }

  bool add(const Image& image, std::string& error) override {
    if (!encoder_ && !begin(image, error)) return false;
    WebPConfig config;
    WebPPicture picture;
    if (!WebPConfigInit(&config) || !WebPPictureInit(&picture)) {
      error = "libwebp is of another version";
      return false;
    }
    config.quality = static_cast<float>(quality_);
    config.use_sharp_yuv = 1;  // edges keep their colours
    picture.use_argb = 1;
    picture.width = image.width;
    picture.height = image.height;
    const Image colours = with_colours(image);
    const auto import = colours.channels == 4 ? WebPPictureImportRGBA : WebPPictureImportRGB;
    const bool taken = import(&picture, colours.pixels.data(), colours.width * colours.channels) != 0;
    const bool done = taken && WebPAnimEncoderAdd(encoder_, &picture, n_++ * milliseconds_, &config) != 0;
    if (!done) error = taken ? WebPAnimEncoderGetError(encoder_) : "out of memory";
    WebPPictureFree(&picture);
    return done;
  }

  std::optional<std::string> finish(std::string& error) override {
    if (!encoder_) {
      error = "there are no pictures";
      return std::nullopt;
    }
    WebPData data;
    WebPDataInit(&data);
    // The end of the last picture.
    const bool done =
        WebPAnimEncoderAdd(encoder_, nullptr, n_ * milliseconds_, nullptr) && WebPAnimEncoderAssemble(encoder_, &data);
    if (!done) {
      error = WebPAnimEncoderGetError(encoder_);
      return std::nullopt;
    }
    std::string bytes(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return bytes;
  }

 private:
  bool begin(const Image& first, std::string& error) {
    if (first.width > WEBP_MAX_DIMENSION || first.height > WEBP_MAX_DIMENSION) {
      error = "WebP pictures have at most 16383 pixels a side";
      return false;
    }
    WebPAnimEncoderOptions options;
    if (!WebPAnimEncoderOptionsInit(&options)) {
      error = "libwebpmux is of another version";
      return false;
    }
    options.allow_mixed = 1;  // of each picture the smaller one, with loss or without
    encoder_ = WebPAnimEncoderNew(first.width, first.height, &options);
    if (!encoder_) error = "out of memory";
    return encoder_ != nullptr;
  }

  static Image with_colours(const Image& image) {
    if (image.channels >= 3) return image;
    Image out{image.width, image.height, image.channels + 2, {}};
    for (std::size_t i = 0; i < image.pixels.size(); i += static_cast<std::size_t>(image.channels)) {
      out.pixels.insert(out.pixels.end(), 3, image.pixels[i]);
      if (image.channels == 2) out.pixels.push_back(image.pixels[i + 1]);
    }
    return out;
  }

  const int milliseconds_, quality_;
  int n_ = 0;
  WebPAnimEncoder* encoder_ = nullptr;
};

}  // namespace

std::unique_ptr<wrlkit::PictureAnimation> wrlkit_begin_webp_animation(int milliseconds, int quality) {
  return std::make_unique<Animation>(milliseconds, quality);
}
