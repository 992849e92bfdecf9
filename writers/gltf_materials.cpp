#include "writers/gltf_materials.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

namespace m = nodes::material;

constexpr Vec3 black{0, 0, 0}, white{1, 1, 1};

}  // namespace

double roughness(double shininess, const Vec3& specular) {
  constexpr double peak = 0.01;  // of the highlight of a surface of alpha 1
  double wide = 2 / (128 * unit_range(shininess) + 2);
  double bright = unit_range(std::max({specular[0], specular[1], specular[2]}));
  return bright <= peak ? 1 : std::pow(std::max(wide, peak / bright), 0.25);
}

/// An appearance on a kind of surface, once the tables of 4.14 are applied.
struct Materials::Look {
  NodeId appearance, material, texture_node, transform_node;
  TextureUse texture;
  UvAffine uv;
  SurfaceKind surface;
  bool lit = false, shows_color = false;
  Vec3 base = white, emissive = black;  // display-referred
  double alpha = 1;
  Alpha mode = Alpha::opaque;
};

bool Materials::has_picture(NodeId appearance) {
  if (!scene_.is(appearance, nodes::Appearance)) return false;
  return textures_.get(scene_.get(appearance, nodes::appearance::texture)).texture != none;
}

MaterialUse Materials::get(NodeId appearance, SurfaceKind s) {
  std::uint64_t key = appearance.value;
  for (bool b : {s.faces, s.color, s.texcoord, s.double_sided}) key = key << 1 | b;
  auto [i, is_new] = uses_.try_emplace(key);
  if (is_new) i->second = make(appearance, s);
  return i->second;
}

MaterialUse Materials::make(NodeId appearance, SurfaceKind s) {
  Look l = look(appearance, s);
  bool bake = l.texture.texture != none && !uv_transform(l.uv);
  auto [i, is_new] = by_json_.try_emplace(json(l), static_cast<std::uint32_t>(materials_.size()));
  if (is_new) materials_.push_back(i->first);
  return {i->second, bake ? l.transform_node : NodeId{}, l.shows_color};
}

Materials::Look Materials::look(NodeId appearance, SurfaceKind s) {
  Look l;
  l.surface = s;
  if (scene_.is(appearance, nodes::Appearance)) {
    namespace a = nodes::appearance;
    l.appearance = appearance;
    l.material = scene_.get(appearance, a::material);
    l.texture_node = scene_.get(appearance, a::texture);
    l.transform_node = scene_.get(appearance, a::textureTransform);
  }
  if (!scene_.is(l.material, nodes::Material)) l.material = {};
  if (!scene_.is(l.transform_node, nodes::TextureTransform)) l.transform_node = {};
  if (s.faces && s.texcoord) l.texture = textures_.get(l.texture_node);
  if (l.texture.texture != none) l.uv = uv_affine(scene_, l.transform_node);

  l.lit = l.material && s.faces;
  bool replaced = l.texture.channels >= 3;
  l.shows_color = s.color && !replaced;
  if (l.material) {
    const Vec3 emissive = scene_.get(l.material, m::emissiveColor);
    if (!s.color && !replaced) l.base = s.faces ? scene_.get(l.material, m::diffuseColor) : emissive;
    if (s.faces) l.emissive = emissive;
    l.alpha = 1 - unit_range(scene_.get(l.material, m::transparency));
  }
  if (l.alpha < 1) l.mode = Alpha::blend;
  if (l.texture.channels % 2 == 0 && l.texture.channels > 0) l.alpha = 1, l.mode = l.texture.alpha;
  return l;
}

std::string Materials::json(const Look& l) {
  std::string text;
  JsonOut json(text);
  json.begin_object();
  auto name_of = [&](NodeId n) { return !n ? std::string_view{} : extras_ ? extras_->name(n) : scene_.name(n); };
  auto name = name_of(l.material).empty() ? name_of(l.appearance) : name_of(l.material);
  if (!name.empty()) json.member("name", name);
  json.key("pbrMetallicRoughness");
  json.begin_object();
  auto base = linear_color(l.base);
  if (l.base != white || l.alpha < 1)
    json.member("baseColorFactor",
                std::span<const float>(std::array{base[0], base[1], base[2], static_cast<float>(l.alpha)}));
  if (l.texture.texture != none) texture_info(json, l);
  json.member("metallicFactor", 0);
  // An unlit material has a fallback for viewers that do not know the extension: as rough as can be.
  double rough = l.lit ? roughness(scene_.get(l.material, m::shininess), scene_.get(l.material, m::specularColor)) : 1;
  if (rough < 1) json.member("roughnessFactor", static_cast<float>(rough));
  json.end_object();
  if (l.emissive != black) json.member("emissiveFactor", std::span<const float>(linear_color(l.emissive)));
  if (l.mode != Alpha::opaque) json.member("alphaMode", l.mode == Alpha::mask ? "MASK" : "BLEND");
  if (l.surface.double_sided) json.member("doubleSided", true);
  if (!l.lit) json.key("extensions"), json.raw(R"({"KHR_materials_unlit":{}})"), unlit_ = true;
  if (extras_) extras(json, l);
  json.end_object();
  return text;
}

void Materials::texture_info(JsonOut& json, const Look& l) {
  json.key("baseColorTexture");
  json.begin_object();
  json.member("index", l.texture.texture);
  if (auto t = uv_transform(l.uv); t && l.uv != UvAffine{}) {
    texture_transform_ = true;
    json.key("extensions");
    json.begin_object();
    json.key("KHR_texture_transform");
    json.begin_object();
    if (t->offset != Vec2{0, 0}) json.member("offset", std::span<const double>(t->offset));
    if (t->rotation != 0) json.member("rotation", t->rotation);
    if (t->scale != Vec2{1, 1}) json.member("scale", std::span<const double>(t->scale));
    json.end_object();
    json.end_object();
  }
  if (extras_ && l.transform_node) {
    json.key("extras");
    json.begin_object();
    extras_->vrml97(json, l.transform_node, {}, !extras_->name(l.transform_node).empty());
    json.end_object();
  }
  json.end_object();
}

/// The fields of Material that the look does not show, and a picture that is not shown at all.
void Materials::extras(JsonOut& json, const Look& l) {
  std::vector<std::uint16_t> said;
  bool from_material = l.material && !l.surface.color && l.texture.channels < 3;
  // White with a picture could be either: a white material, or one that the picture replaces.
  if (from_material && l.surface.faces && (l.texture.texture == none || l.base != white)) said.push_back(m::diffuseColor.slot);
  if (l.material && (l.surface.faces || !l.surface.color)) said.push_back(m::emissiveColor.slot);
  if (l.texture.channels % 2 == 1 || l.texture.channels == 0) said.push_back(m::transparency.slot);
  // White and unlit is what a Shape without a Material is, too.
  bool material = l.material && (extras_->anything(l.material, said) || (!l.lit && l.base == white && l.alpha == 1));
  bool named = l.appearance && !extras_->name(l.appearance).empty();
  bool picture = l.texture_node && l.texture.texture == none;
  for (NodeId n : {l.appearance, l.material, l.texture.texture == none ? NodeId{} : l.texture_node})
    if (n) extras_->set_placed(n);
  bool transform = l.transform_node && l.texture.texture == none;
  if (!material && !picture && !named && !transform) return;
  json.key("extras");
  json.begin_object();
  json.key("vrml97");
  json.begin_object();
  if (named) json.key("Appearance"), json.begin_object(), json.member("DEF", extras_->name(l.appearance)), json.end_object();
  if (material) extras_->node(json, l.material, said);
  if (picture) extras_->node(json, l.texture_node, {}, !extras_->name(l.texture_node).empty());
  if (transform) extras_->node(json, l.transform_node, {}, !extras_->name(l.transform_node).empty());
  json.end_object();
  json.end_object();
}

}  // namespace wrlkit::gltf
