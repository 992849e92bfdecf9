// The textures of materials, with their pictures and samplers.
#include "base/image/image.h"
#include "base/image/srgb_table.h"
#include "base/io/url.h"
#include "parsers/gltf/materials.h"
#include "scenegraph/looks/texture_sampler.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {

NodeId Materials::texture(std::uint32_t index) {
  auto [i, is_new] = textures_.try_emplace(index);
  if (is_new) i->second = make_texture(c_.file.at(Table::textures, index));
  return i->second;
}

std::uint32_t Materials::image_of(Json t) const {
  const Json webp = t["extensions"]["EXT_texture_webp"]["source"];
  return c_.file.index(Table::images, t["source"] ? t["source"] : webp);
}

NodeId Materials::make_texture(Json t) {
  const auto image = image_of(t);
  const Json extras = vrml97(t);
  if (image == none) {
    c_.lost.add("a texture without a picture", c_.file.where(t));
    return NodeId{};
  }
  NodeId n;
  if (extras["PixelTexture"]) n = pixel_texture(t, c_.file.at(Table::images, image));
  if (!n) {
    n = c_.add(nodes::ImageTexture, t);
    auto all = urls(t, image);
    std::vector<std::string_view> views(all.begin(), all.end());
    c_.scene.set(n, nodes::image_texture::url, views);
  }
  const auto sampler_index = c_.file.index(Table::samplers, t["sampler"]);
  if (sampler_index != none) set_sampler(n, c_.file.at(Table::samplers, sampler_index));
  c_.set_name(n, t["name"]);
  if (c_.file.is_own()) extras_.tags(n, extras[c_.scene.type(n).name]);
  c_.lost.keep(c_.file, t);
  return n;
}

/// Repeated or clamped by repeatS and repeatT; what these cannot say by a TextureProperties.
void Materials::set_sampler(NodeId n, Json sampler) {
  namespace i = nodes::image_texture;
  namespace x = nodes::pixel_texture;
  namespace p = nodes::texture_properties;
  constexpr double clamp = 33071, mirror = 33648, nearest = 9728;
  const double s = sampler["wrapS"].number(), t = sampler["wrapT"].number();
  const bool pixels = c_.scene.is(n, nodes::PixelTexture);
  const bool squares = sampler["magFilter"].number() == nearest;
  if (s != mirror && t != mirror && !squares) {
    for (auto [wrap, slot] : {std::pair(s, pixels ? x::repeatS.slot : i::repeatS.slot),
                              std::pair(t, pixels ? x::repeatT.slot : i::repeatT.slot)})
      if (wrap == clamp) c_.scene.set(n, c_.scene.make(FieldType::SFBool, slot, false));
    return;
  }
  const auto mode = [&](double wrap) -> std::string_view {
    return wrap == mirror ? "MIRRORED_REPEAT" : wrap == clamp ? "CLAMP_TO_EDGE" : "REPEAT";
  };
  const NodeId properties = c_.add(nodes::TextureProperties, sampler);
  c_.scene.set(properties, p::boundaryModeS, mode(s), p::boundaryModeT, mode(t));
  if (squares) c_.scene.set(properties, p::magnificationFilter, std::string_view("NEAREST_PIXEL"));
  const double minified = sampler["minFilter"].number();
  for (const auto known :
       {TextureSampler::Minified::nearest, TextureSampler::Minified::linear,
        TextureSampler::Minified::nearest_mipmap_nearest, TextureSampler::Minified::linear_mipmap_nearest,
        TextureSampler::Minified::nearest_mipmap_linear})
    if (minified == static_cast<double>(known))
      c_.scene.set(properties, p::minificationFilter, minification_filter(known));
  if (pixels)
    c_.scene.set(n, x::textureProperties, properties);
  else
    c_.scene.set(n, i::textureProperties, properties);
}

std::optional<Image> Materials::decoded(Json image) {
  auto view = c_.file.index(Table::bufferViews, image["bufferView"]);
  auto inside = view == none ? std::nullopt : c_.buffers.view(view);
  auto beside = inside || !image["uri"] ? std::nullopt : c_.buffers.load(image, image["uri"].text());
  std::string why;
  if (inside) return decode_image(inside->bytes, "pixels.png", why);
  return beside ? decode_image(*beside, "pixels.png", why) : std::nullopt;
}

/// A picture of linear numbers, as occlusionTexture has them, as lightmaps are: display-referred.
NodeId Materials::light_of_linear(std::uint32_t index) {
  auto [at, is_new] = linear_lights_.try_emplace(index);
  if (!is_new) return at->second;
  const auto number = image_of(c_.file.at(Table::textures, index));
  auto picture = number == none ? std::nullopt : decoded(c_.file.at(Table::images, number));
  if (!picture) return {};
  const SrgbTable& table = SrgbTable::get();
  for (auto& v : picture->pixels) v = table.byte(v / 255.0);
  std::string why;
  const auto bytes = encode_as("light.png", *picture, why);
  if (!bytes) return {};
  const NodeId n = at->second = c_.add(nodes::ImageTexture, c_.file.at(Table::textures, index));
  const std::string url = data_url("image/png", *bytes);
  c_.scene.set(n, nodes::image_texture::url, std::vector<std::string_view>{url}, nodes::image_texture::repeatS, false,
               nodes::image_texture::repeatT, false);
  return n;
}

/// An SFImage (ISO/IEC 14772-1, 5.5) from the picture that it was written as.
NodeId Materials::pixel_texture(Json t, Json image) {
  const auto picture = decoded(image);
  if (!picture) return {};
  std::vector<std::int32_t> v{picture->width, picture->height, picture->channels};
  const auto row = static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->channels);
  for (auto y = static_cast<std::size_t>(picture->height); y-- > 0;)
    for (std::size_t x = 0; x < row; x += static_cast<std::size_t>(picture->channels)) {
      std::uint32_t pixel = 0;
      for (int k = 0; k < picture->channels; ++k)
        pixel = pixel << 8 | picture->pixels[y * row + x + static_cast<std::size_t>(k)];
      v.push_back(static_cast<std::int32_t>(pixel));
    }
  NodeId n = c_.add(nodes::PixelTexture, t);
  c_.scene.set(n, nodes::pixel_texture::image, v);
  return n;
}

/// That of the picture in or next to the file, then those that it had in VRML: what lies there may be another one.
std::vector<std::string> Materials::urls(Json t, std::uint32_t index) {
  std::vector<std::string> all;
  const Json image = c_.file.at(Table::images, index);
  if (const auto uri = image["uri"].text(); !uri.empty())
    all.emplace_back(uri);
  else if (auto inside = picture_url(index, image); !inside.empty())
    all.push_back(std::move(inside));
  for (Json url : vrml97(t)["ImageTexture"]["url"].elements())
    if (std::ranges::find(all, url.text()) == all.end()) all.emplace_back(url.text());
  return all;
}

/// Of a picture in the file, which is decoded once; empty: there is none.
std::string Materials::picture_url(std::uint32_t index, Json image) {
  auto& url = image_urls_[index];
  const auto view = url.empty() ? c_.file.index(Table::bufferViews, image["bufferView"]) : none;
  if (const auto bytes = view == none ? std::nullopt : c_.buffers.view(view)) {
    const auto mime = sniff_mime(bytes->bytes);
    url = data_url(mime.empty() ? image["mimeType"].text() : mime, bytes->bytes);
  }
  return url;
}

}  // namespace wrlkit::gltf_reader
