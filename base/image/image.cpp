#include "base/image/image.h"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <filesystem>

#include "base/image/decode.h"
#include "base/image/image_codecs.h"
#include "base/image/image_module.h"
#include "base/image/png.h"
#include "base/io/own_files.h"
#include "base/text/letter_case.h"

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

constexpr const char* module_name = "wrlkit_images.so";

/// As set_image_codecs was told; empty: not at all.
fs::path& chosen_module() {
  static fs::path chosen;
  return chosen;
}

/// Where the module may be, the best first: see set_image_codecs.
std::vector<fs::path> module_paths() { return own_files(module_name, "WRLKIT_IMAGES", {chosen_module()}); }

struct Opened {
  const ImageModule* module = nullptr;
  std::string error = "the module of codecs, wrlkit_images.so, is not installed (WRLKIT_IMAGES may name it)";
};

std::atomic<bool> loaded = false;

Opened open_module() {
  loaded = true;
  Opened opened;
  for (auto& path : module_paths()) {
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    auto entry = handle ? reinterpret_cast<decltype(&wrlkit_images)>(dlsym(handle, "wrlkit_images")) : nullptr;
    if (entry) return {entry(), {}};
    opened.error = path.string() + " cannot be loaded: " + dlerror();
  }
  return opened;
}

const Opened& image_module() {
  static const Opened opened = open_module();
  return opened;
}

struct Codec {
  std::string_view mime;
  const char* name;  // OpenImageIO's
};

constexpr Codec codecs[] = {
    {"image/jpeg", "jpeg"}, {"image/gif", "gif"},   {"image/bmp", "bmp"},       {"image/x-tga", "targa"},
    {"image/tiff", "tiff"}, {"image/webp", "webp"}, {"image/x-exr", "openexr"}, {"image/vnd.radiance", "hdr"},
};

bool alpha_is_nothing(const Image& image) {
  for (std::size_t i = image.channels - 1; i < image.pixels.size(); i += image.channels)
    if (image.pixels[i] != 0) return false;
  return true;
}

bool decode_by_module(std::string_view bytes, std::string_view mime, Image& image, std::string& error) {
  auto codec = std::ranges::find(codecs, mime, &Codec::mime);
  if (codec == std::end(codecs)) {
    error = "it is no picture of a known type";
    return false;
  }
  auto& opened = image_module();
  if (!opened.module) {
    error = opened.error;
    return false;
  }
  return opened.module->decode({bytes, codec->name, &image_size_fault}, image, error);
}

bool decode(std::string_view bytes, std::string_view mime, Image& image, std::string& error) {
  if (mime == "image/png") return decode_png(bytes, image, error);
  if (mime == "image/jpeg" && is_plain_jpeg(bytes)) return decode_jpeg(bytes, image, error);
  if (mime == "image/x-sgi") return decode_sgi(bytes, image, error);
  if (mime == "image/vnd-ms.dds") return decode_dds(bytes, image, error);
  if (mime == "image/x-pcx") return decode_pcx(bytes, image, error);
  if (mime == "image/x-xbitmap") return decode_xbm(bytes, image, error);
  return decode_by_module(bytes, mime, image, error);
}

template <class Picture>
bool has_pixels(const Picture& image) {
  auto pixels = std::uint64_t(image.width) * std::uint64_t(image.height) * std::uint64_t(image.channels);
  return image.width > 0 && image.height > 0 && image.channels >= 1 && image.channels <= 4 &&
         image.pixels.size() == pixels;
}

/// The bytes that `write(module, bytes)` makes of a picture that has all its pixels.
template <class Picture, class Write>
std::optional<std::string> encode_with(const Picture& image, std::string& error, Write write) {
  if (!has_pixels(image)) {
    error = "it has no pixels";
    return std::nullopt;
  }
  auto& opened = image_module();
  if (!opened.module) {
    error = opened.error;
    return std::nullopt;
  }
  std::string bytes;
  if (!write(*opened.module, bytes)) return std::nullopt;
  return bytes;
}

std::optional<std::string> encode(const Image& image, const char* codec, int quality, std::string& error) {
  return encode_with(image, error, [&](const ImageModule& module, std::string& bytes) {
    return module.encode(image, codec, quality, bytes, error);
  });
}

constexpr int unseen_losses = 92;  // quality

std::optional<std::string> jpeg_of(const Image& image, std::string& error) {
  return encode_jpeg(image, unseen_losses, error);
}
std::optional<std::string> webp_of(const Image& image, std::string& error) {
  return encode_webp(image, unseen_losses, error);
}

struct Extension {
  std::string_view end;
  std::optional<std::string> (*encode)(const Image&, std::string& error);
};
constexpr Extension extensions[] = {{".png", encode_png}, {".jpg", jpeg_of}, {".jpeg", jpeg_of}, {".webp", webp_of}};

const Extension* extension_of(std::string_view name) {
  auto i = std::ranges::find_if(extensions, [&](const Extension& e) { return ends_with_ignoring_case(name, e.end); });
  return i == std::end(extensions) ? nullptr : i;
}

}  // namespace

std::optional<Image> decode_image(std::string_view bytes, std::string_view name, std::string& error) {
  auto mime = sniff_mime(bytes, name);
  auto header = read_image_header(bytes, name);
  if (header) {
    error = image_size_fault(header->width, header->height, bytes.size());
    if (!error.empty()) return std::nullopt;
  }
  Image image;
  if (!decode(bytes, mime, image, error)) return std::nullopt;
  if (header) image = with_channels(std::move(image), header->channels);
  // Many programs that write BMP and TGA leave the fourth byte 0; a picture of nothing is never meant.
  if (header && header->alpha && (mime == "image/bmp" || mime == "image/x-tga") && alpha_is_nothing(image))
    image = with_channels(with_channels(std::move(image), header->channels - 1), header->channels);
  return image;
}

bool set_image_codecs(const std::string& path) {
  if (loaded || !fs::path(path).is_absolute()) return false;
  chosen_module() = path;
  return true;
}

void load_image_codecs() { image_module(); }
bool image_codecs_are_loaded() { return loaded; }

std::optional<std::string> encode_png(const Image& image, std::string& error) {
  if (!has_pixels(image)) {
    error = "it has no pixels";
    return std::nullopt;
  }
  return png_of(image);
}

std::optional<std::string> encode_jpeg(const Image& image, int quality, std::string& error) {
  bool alpha = image.channels % 2 == 0;
  return encode(alpha ? with_channels(image, image.channels - 1) : image, "jpeg", std::clamp(quality, 1, 100), error);
}

std::optional<std::string> encode_webp(const Image& image, int quality, std::string& error) {
  int channels = image.channels % 2 == 0 ? 4 : 3;
  return encode(image.channels == channels ? image : with_channels(image, channels), "webp",
                std::clamp(quality, 1, 100), error);
}

std::optional<std::string> encode_exr(const FloatImage& image, std::string& error) {
  return encode_with(image, error, [&](const ImageModule& module, std::string& bytes) {
    return module.encode_exr(image, bytes, error);
  });
}

std::unique_ptr<PictureAnimation> begin_webp_animation(int milliseconds, std::string& error) {
  auto& opened = image_module();
  if (!opened.module) {
    error = opened.error;
    return nullptr;
  }
  if (!opened.module->begin_webp_animation) {
    error = "this program was built without libwebpmux, which writes animations";
    return nullptr;
  }
  return opened.module->begin_webp_animation(milliseconds, unseen_losses);
}

std::optional<std::string> encode_as(std::string_view name, const Image& image, std::string& error) {
  auto* e = extension_of(name);
  return e ? e->encode(image, error) : std::nullopt;
}

bool can_encode_as(std::string_view name) { return extension_of(name) != nullptr; }

Image with_channels(Image from, int channels) {
  if (from.channels == channels) return from;
  Image to{from.width, from.height, channels, {}};
  const std::size_t n = from.pixels.size() / from.channels;
  const int colours = channels < 3 ? 1 : 3, step = from.channels < 3 ? 0 : 1;  // step: grey is every colour
  to.pixels.resize(n * channels);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t* p = &from.pixels[i * from.channels];
    std::uint8_t* q = &to.pixels[i * channels];
    for (int c = 0; c < colours; ++c) q[c] = p[c * step];
    if (channels > colours) q[colours] = from.channels % 2 == 0 ? p[from.channels - 1] : 255;
  }
  return to;
}

}  // namespace wrlkit
