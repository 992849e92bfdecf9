#include "light/render/surface.h"

#include <algorithm>

#include "scenegraph/nodes.h"
#include "scenegraph/picture_color.h"

namespace wrlkit::drawing {
namespace {

/// Metals are as dull as all else; their colour is what they reflect.
void read_material(Surface& s, const Scene& scene, NodeId n) {
  auto read = [&](auto color, auto transparency) {
    s.material.diffuse = scene.get(n, color);
    s.alpha = 1 - std::clamp(scene.get(n, transparency), 0.0, 1.0);
  };
  namespace m = nodes::material;
  namespace p = nodes::physical_material;
  namespace u = nodes::unlit_material;
  s.shines = scene.is(n, nodes::UnlitMaterial);
  if (s.shines) return read(u::emissiveColor, u::transparency);
  s.lit = true;
  if (scene.is(n, nodes::PhysicalMaterial)) {
    read(p::baseColor, p::transparency);
    s.material.specular = {};
    s.emissive = scene.get(n, p::emissiveColor);
    return;
  }
  read(m::diffuseColor, m::transparency);
  s.material.specular = scene.get(n, m::specularColor);
  s.material.ambient = scene.get(n, m::ambientIntensity);
  s.material.shininess = std::clamp(scene.get(n, m::shininess), 0.0, 1.0);
  s.emissive = scene.get(n, m::emissiveColor);
}

bool is_material(const Scene& scene, NodeId n) {
  return scene.is(n, nodes::Material) || scene.is(n, nodes::PhysicalMaterial) || scene.is(n, nodes::UnlitMaterial);
}

/// TextureTransform (6.49): Tc' = -C S R C T Tc.
TexcoordMap texcoord_map(const Scene& scene, NodeId n) {
  namespace f = nodes::texture_transform;
  auto center = scene.get(n, f::center), scale = scene.get(n, f::scale), shift = scene.get(n, f::translation);
  double c = std::cos(scene.get(n, f::rotation)), s = std::sin(scene.get(n, f::rotation));
  double x = shift[0] + center[0], y = shift[1] + center[1];
  TexcoordMap m{scale[0] * c, -scale[0] * s, 0, scale[1] * s, scale[1] * c, 0};
  m.c = m.a * x + m.b * y - center[0];
  m.f = m.d * x + m.e * y - center[1];
  return m;
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
  if (picture.texture->has_alpha()) out.alpha = texel.alpha;
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
  NodeId material = scene_.get(appearance, f::material), map = scene_.get(appearance, f::textureTransform);
  s.modulates = multiplies_picture(scene_, appearance);
  if (is_material(scene_, material)) read_material(s, scene_, material);
  if (scene_.is(map, nodes::TextureTransform)) s.texcoords = texcoord_map(scene_, map);
  const NodeId texture = scene_.get(appearance, f::texture);
  s.picture = layer(texture ? texture : own_picture(scene_, material));
  if (scene_.is(material, nodes::Material)) further_pictures(s, material);
  read_alpha_mode(s, appearance);
  s.baked = baked_light(appearance);
  return s;
}

void Surfaces::further_pictures(Surface& s, NodeId n) {
  namespace f = nodes::material;
  s.glow = layer(scene_.get(n, f::emissiveTexture));
  s.shadow = layer(scene_.get(n, f::occlusionTexture));
  s.bumps = layer(scene_.get(n, f::normalTexture));
  s.bump_scale = scene_.get(n, f::normalScale);
  s.shadow_strength = std::clamp(scene_.get(n, f::occlusionStrength), 0.0, 1.0);
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
  if (NodeId map = scene_.get(appearance, f::lightmapTransform); scene_.is(map, nodes::TextureTransform))
    b.places = texcoord_map(scene_, map);
  auto direction = scene_.get(appearance, f::lightmapDirection);
  if (direction.size() != b.direction.size()) return b;
  std::ranges::transform(direction, b.direction.begin(), [&](NodeId n) { return layer(n); });
  if (!std::ranges::all_of(b.direction, [](const Layer& l) { return l.texture != nullptr; })) b.direction = {};
  return b;
}

Layer Surfaces::layer(NodeId n) {
  if (!n) return {};
  auto [at, is_new] = layers_.try_emplace(n.value);
  if (is_new) at->second = make_layer(n);
  return at->second;
}

Layer Surfaces::make_layer(NodeId n) {
  if (scene_.is(n, nodes::PixelTexture)) {
    namespace f = nodes::pixel_texture;
    return {Texture::make(image_of(scene_.get(n, f::image))), scene_.get(n, f::repeatS), scene_.get(n, f::repeatT)};
  }
  if (!scene_.is(n, nodes::ImageTexture) || !resources_) return {};
  namespace f = nodes::image_texture;
  auto urls = scene_.get(n, f::url);
  if (urls.empty()) return {};
  return {picture(resources_->image(urls, scene_.where(n), diag_)), scene_.get(n, f::repeatS),
          scene_.get(n, f::repeatT)};
}

std::shared_ptr<const Texture> Surfaces::picture(const std::shared_ptr<const Image>& image) {
  if (!image) return nullptr;
  auto [at, added] = textures_.try_emplace(image);
  if (added) at->second = Texture::make(*image);
  return at->second;
}

}  // namespace wrlkit::drawing
