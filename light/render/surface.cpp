#include "light/render/surface.h"

#include <algorithm>

#include "scenegraph/looks/picture_color.h"
#include "scenegraph/nodes.h"

namespace wrlkit::drawing {
namespace {

/// Metals are as dull as all else; their colour is what they reflect.
void set_material(Surface& s, const MaterialNode& m) {
  s.shines = m.kind == MaterialNode::Kind::unlit;
  s.lit = !s.shines;
  s.material.diffuse = m.color;
  s.alpha = 1 - std::clamp(m.transparency, 0.0, 1.0);
  if (s.shines) return;
  s.material.specular = m.specular;
  s.material.ambient = m.ambient_intensity;
  s.material.shininess = std::clamp(m.shininess, 0.0, 1.0);
  s.emissive = m.emissive;
}

}  // namespace

V3 BakedLight::at(const std::array<double, 2>& place, double detail) const {
  return scale * to_linear(light.sample(place, detail).color);
}

Texel Surface::base(const std::optional<Texel>& vertex, const std::optional<Texel>& texel) const {
  Texel out{lit || shines ? material.diffuse : V3(1), alpha};
  if (vertex) {
    out.color = vertex->color;
    out.alpha *= vertex->alpha;
  }
  if (texel) add(out, *texel);
  if (opaque) out.alpha = 1;
  if (cutoff) out.alpha = out.alpha >= *cutoff ? 1 : 0;
  return out;
}

void Surface::add(Texel& out, const Texel& texel) const {
  out.color = modulates || picture.texture->is_grey() ? texel.color * out.color : texel.color;
  if (picture.texture->has_alpha()) out.alpha = modulates ? texel.alpha * out.alpha : texel.alpha;
}

Surfaces::Surfaces(const Scene& scene, Resources* resources, Diagnostics& diag)
    : scene_(scene), resources_(resources), diag_(diag), surfaces_(1), index_(scene.node_count()) {}

std::uint32_t Surfaces::of(NodeId appearance) {
  if (!scene_.is(appearance, nodes::Appearance)) return 0;
  std::uint32_t& i = index_[appearance.value];
  if (!i) {
    surfaces_.push_back(make(appearance));
    i = static_cast<std::uint32_t>(surfaces_.size() - 1);
  }
  return i;
}

Surface Surfaces::make(NodeId appearance) {
  namespace f = nodes::appearance;
  Surface s;
  const auto material = material_of(scene_, appearance);
  s.modulates = multiplies_picture(scene_, appearance);
  if (material) set_material(s, *material);
  s.texcoords = read_texture_transform(scene_, scene_.get(appearance, f::textureTransform)).map();
  const NodeId texture = scene_.get(appearance, f::texture);
  s.picture = layer(texture || !material ? texture : material->color_picture);
  if (s.lit) further_pictures(s, *material);
  read_alpha_mode(s, appearance);
  s.hatch = read_hatch(scene_, scene_.get(appearance, f::fillProperties));
  s.baked = baked_light(appearance);
  return s;
}

void Surfaces::further_pictures(Surface& s, const MaterialNode& m) {
  s.glow = layer(m.emissive_picture);
  s.shadow = layer(m.occlusion_picture, Texture::Means::numbers);
  s.bumps = layer(m.normal_picture, Texture::Means::numbers);
  s.bump_scale = m.normal_scale;
  s.shadow_strength = std::clamp(m.occlusion_strength, 0.0, 1.0);
}

void Surfaces::read_alpha_mode(Surface& s, NodeId appearance) const {
  const auto mode = scene_.get(appearance, nodes::appearance::alphaMode);
  s.opaque = mode == "OPAQUE";
  if (mode == "MASK") s.cutoff = scene_.get(appearance, nodes::appearance::alphaCutoff);
}

BakedLight Surfaces::baked_light(NodeId appearance) {
  namespace f = nodes::appearance;
  BakedLight b;
  b.light = layer(scene_.get(appearance, f::lightmap));
  if (!b) return b;
  b.scale = scene_.get(appearance, f::lightmapScale);
  b.places = read_texture_transform(scene_, scene_.get(appearance, f::lightmapTransform)).map();
  auto direction = scene_.get(appearance, f::lightmapDirection);
  if (direction.size() != b.direction.size()) return b;
  std::ranges::transform(direction, b.direction.begin(), [&](NodeId n) { return layer(n, Texture::Means::numbers); });
  if (!std::ranges::all_of(b.direction, [](const Layer& l) { return l.texture != nullptr; })) b.direction = {};
  return b;
}

Layer Surfaces::layer(NodeId n, Texture::Means means) {
  if (!n) return {};
  auto [at, is_new] = layers_.try_emplace({n.value, means});
  if (is_new) at->second = make_layer(n, means);
  return at->second;
}

Layer Surfaces::make_layer(NodeId n, Texture::Means means) {
  const TextureSampler sampler = read_sampler(scene_, n);
  if (scene_.is(n, nodes::PixelTexture))
    return {Texture::make(image_of(scene_.get(n, nodes::pixel_texture::image)), means), sampler};
  if (!scene_.is(n, nodes::ImageTexture) || !resources_) return {};
  const auto urls = scene_.get(n, nodes::image_texture::url);
  if (urls.empty()) return {};
  return {picture(resources_->image(urls, scene_.where(n), diag_), means), sampler};
}

std::shared_ptr<const Texture> Surfaces::picture(const std::shared_ptr<const Image>& image, Texture::Means means) {
  if (!image) return nullptr;
  auto [at, added] = textures_.try_emplace({image, means});
  if (added) at->second = Texture::make(*image, means);
  return at->second;
}

}  // namespace wrlkit::drawing
