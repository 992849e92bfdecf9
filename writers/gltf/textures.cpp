#include "writers/gltf/textures.h"

#include <algorithm>

#include "base/text/letter_case.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "writers/gltf/color.h"

namespace wrlkit::gltf {
namespace {

/// An SFImage (ISO/IEC 14772-1, 5.5): width, height, channels, then a number for each pixel, from the bottom row up.
std::optional<Image> image_of(std::span<const std::int32_t> v) {
  if (v.size() < 3 || v[0] <= 0 || v[1] <= 0 || v[2] < 1 || v[2] > 4) return std::nullopt;
  const auto width = static_cast<std::size_t>(v[0]), height = static_cast<std::size_t>(v[1]);
  if ((v.size() - 3) / width < height) return std::nullopt;
  Image image{v[0], v[1], v[2], {}};
  image.pixels.reserve(width * height * static_cast<std::size_t>(v[2]));
  for (std::size_t row = height; row-- > 0;)
    for (std::size_t i = 0; i < width; ++i)
      for (int c = v[2] - 1; c >= 0; --c)
        image.pixels.push_back(
            static_cast<std::uint8_t>(static_cast<std::uint32_t>(v[3 + row * width + i]) >> (8 * c)));
  return image;
}

std::string with_extension(const std::string& name, std::string_view extension) {
  return name.substr(0, name.find_last_of('.')) + std::string(extension);
}

/// The file name with the extension that belongs to its contents: readers go by it.
std::string honest_name(const std::string& name, std::string_view mime) {
  auto ends = [&](std::string_view e) { return name.size() > e.size() && ends_with_ignoring_case(name, e); };
  for (auto [type, extension] : {std::pair{"image/png", ".png"}, {"image/webp", ".webp"}})
    if (mime == type) return ends(extension) ? name : with_extension(name, extension);
  return ends(".jpg") || ends(".jpeg") ? name : with_extension(name, ".jpg");
}

/// The file untouched, where glTF takes it.
std::optional<Picture> untouched(const std::shared_ptr<const Blob>& blob, std::string_view mime) {
  auto portable = portable_image(blob->bytes, mime);
  if (!portable.usable) return std::nullopt;
  Picture p{honest_name(blob->name, mime), mime, blob->bytes, blob};
  if (portable.cleaned) {
    auto bytes = std::make_shared<const std::string>(std::move(*portable.cleaned));
    p.bytes = *bytes;
    p.owner = bytes;
  }
  return p;
}

}  // namespace

std::span<const std::uint16_t> said_by_texture(const Scene& scene, NodeId n) {
  namespace i = nodes::image_texture;
  namespace p = nodes::pixel_texture;
  static constexpr std::uint16_t image[] = {i::repeatS.slot, i::repeatT.slot},
                                 pixels[] = {p::image.slot, p::repeatS.slot, p::repeatT.slot};
  return scene.is(n, nodes::PixelTexture) ? std::span<const std::uint16_t>(pixels) : image;
}

TextureUse Textures::get(NodeId n, PixelMeaning meaning) {
  if (!n) return {};
  auto [i, is_new] = by_node_.try_emplace({n.value, meaning});
  if (is_new) i->second = make(n, meaning);
  return i->second;
}

bool Textures::uses_webp() const {
  return std::ranges::any_of(pictures_, [](const Picture& p) { return p.is_webp(); });
}

TextureUse Textures::make(NodeId n, PixelMeaning meaning) {
  if (scene_.is(n, nodes::ImageTexture)) return make(n, load_file(n, meaning), read_sampler(scene_, n));
  if (scene_.is(n, nodes::PixelTexture)) return make(n, load_pixels(n, meaning), read_sampler(scene_, n));
  if (scene_.is(n, nodes::MovieTexture)) {
    auto urls = scene_.get(n, nodes::movie_texture::url);
    diag_.report(Diag::no_gltf_movie, scene_.where(n), urls.empty() ? std::string_view{} : urls[0]);
  }
  return {};
}

std::shared_ptr<const Image> Textures::image(NodeId n) {
  if (scene_.is(n, nodes::ImageTexture) && resources_)
    return resources_->image(scene_.get(n, nodes::image_texture::url), scene_.where(n), diag_);
  auto pixels = scene_.is(n, nodes::PixelTexture) ? image_of(scene_.get(n, nodes::pixel_texture::image)) : std::nullopt;
  return pixels ? std::make_shared<const Image>(std::move(*pixels)) : nullptr;
}

TextureUse Textures::brightness(NodeId n, double scale) {
  auto [at, is_new] = brightness_.try_emplace({n.value, scale});
  auto light = is_new && n ? image(n) : nullptr;
  if (!light) return at->second;
  Image grey{light->width, light->height, 1, {}};
  const Image rgb = with_channels(*light, 3);
  for (std::size_t i = 0; i < rgb.pixels.size(); i += 3) {
    auto part = [&](std::size_t c) { return srgb_to_linear(rgb.pixels[i + c] / 255.0); };
    double y = scale * (0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2));  // ITU-R BT.709
    grey.pixels.push_back(static_cast<std::uint8_t>(unit_range(y) * 255 + 0.5));
  }
  return at->second = make(n,
                           stored(n, scene_.name(n).empty() ? "light" : std::string(scene_.name(n)) + "_light", grey,
                                  PixelMeaning::data),
                           {.s = Wrap::clamp, .t = Wrap::clamp});
}

TextureUse Textures::make(NodeId n, const Loaded& loaded, TextureSampler sampler) {
  if (loaded.picture == none) return {};
  auto s = static_cast<std::uint32_t>(std::ranges::find(samplers_, sampler) - samplers_.begin());
  if (s == samplers_.size()) samplers_.push_back(sampler);
  const bool tagged = has_tags(scene_, n);
  auto same = [&](const Texture& t) {
    if (t.source != n && (tagged || has_tags(scene_, t.source))) return false;
    return t.picture == loaded.picture && t.sampler == s && scene_.name(t.source) == scene_.name(n);
  };
  // Few textures share a picture, and those that do were made close together.
  auto recent = textures_.end() - std::min<std::ptrdiff_t>(std::ssize(textures_), 64);
  auto known = std::find_if(recent, textures_.end(), same);
  auto id = static_cast<std::uint32_t>(known - textures_.begin());
  if (known == textures_.end()) textures_.push_back({loaded.picture, s, n});
  return {id, loaded.channels, loaded.alpha};
}

Textures::Loaded Textures::load_file(NodeId n, PixelMeaning meaning) {
  auto urls = scene_.get(n, nodes::image_texture::url);
  if (urls.empty() || !resources_) return {};
  auto blob = resources_->bytes(urls, scene_.where(n), diag_);
  if (!blob) return {};
  auto [i, is_new] = by_file_.try_emplace({blob, meaning});
  if (!is_new) return i->second;
  const auto header = read_image_header(blob->bytes, blob->name);
  auto plain = header ? untouched(blob, header->mime) : std::nullopt;
  Loaded loaded;
  if (plain && !header->alpha &&
      !may_recode(options_, {plain->mime, plain->bytes.size()}, header->width, header->height))
    loaded = {add(std::move(*plain)), header->channels, Alpha::opaque};
  else if (auto image = resources_->image(urls, scene_.where(n), diag_))
    loaded = stored(n, blob->name, *image, meaning, blob->bytes.size(), std::move(plain));
  return by_file_[{blob, meaning}] = loaded;
}

Textures::Loaded Textures::load_pixels(NodeId n, PixelMeaning meaning) {
  auto numbers = scene_.get(n, nodes::pixel_texture::image);
  auto image = image_of(numbers);
  if (!image) {
    bool says_nothing = numbers.size() < 2 || numbers[0] == 0 || numbers[1] == 0;
    if (!says_nothing)
      diag_.report(Diag::image_unreadable, scene_.where(n), "PixelTexture", "its numbers are not those of a picture");
    return {};
  }
  return stored(n, scene_.name(n).empty() ? "pixels" : std::string(scene_.name(n)), *image, meaning);
}

/// In the format and size that are asked for, of a file of that many bytes; `plain`: glTF would take that.
Textures::Loaded Textures::stored(NodeId n, const std::string& name, const Image& image, PixelMeaning meaning,
                                  std::size_t bytes_before, std::optional<Picture> plain) {
  const PlainFile file{plain ? plain->mime : std::string_view(), plain ? plain->bytes.size() : bytes_before};
  std::string error;
  auto made = recoded(image, meaning, file, options_, error);
  if (!made && !error.empty()) diag_.report(Diag::image_unreadable, scene_.where(n), name, error);
  if (!made && !plain) return {};
  const Alpha alpha = alpha_of(image);
  if (!made) return {add(std::move(*plain)), image.channels, alpha};
  if (file.bytes > 0 || made->resized || made->psnr > 0) {
    ++recoding_.pictures;
    recoding_.resized += made->resized;
    recoding_.before += file.bytes;
    recoding_.after += made->bytes.size();
    if (made->psnr > 0) recoding_.psnr = recoding_.psnr > 0 ? std::min(recoding_.psnr, made->psnr) : made->psnr;
  }
  auto bytes = std::make_shared<const std::string>(std::move(made->bytes));
  return {add({honest_name(name, made->mime), made->mime, *bytes, bytes}), image.channels, alpha};
}

std::uint32_t Textures::add(Picture p) {
  auto [i, is_new] = by_bytes_.try_emplace(p.bytes, static_cast<std::uint32_t>(pictures_.size()));
  if (is_new) pictures_.push_back(std::move(p));
  return i->second;
}

}  // namespace wrlkit::gltf
