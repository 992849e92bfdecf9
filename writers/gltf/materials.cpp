#include "writers/gltf/materials.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scenegraph/looks/material_node.h"
#include "scenegraph/looks/picture_color.h"
#include "scenegraph/looks/shininess.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf {
namespace {

namespace m = nodes::material;

constexpr Vec3 black{0, 0, 0}, white{1, 1, 1};

}  // namespace

double roughness(double shininess, const Vec3& specular) {
  constexpr double peak = 0.01;  // of the highlight of a surface of alpha 1
  const double wide = highlight_width(unit_range(shininess));
  double bright = unit_range(std::max({specular[0], specular[1], specular[2]}));
  return bright <= peak ? 1 : std::pow(std::max(wide, peak / bright), 0.25);
}

/// An appearance on a kind of surface, once the tables of 4.14 are applied.
struct Materials::Look {
  std::optional<MaterialNode> says;  // what the material does
  NodeId appearance, material, texture_node, transform_node;
  TextureUse texture;
  TexcoordMap uv;
  SurfaceKind surface;
  TextureUse light;
  NodeId light_transform;
  TexcoordMap light_uv;
  bool lit = false, shows_color = false, shows_alpha = true;
  std::string_view base_field;          // of the material
  Vec3 base = white, emissive = black;  // display-referred
  double alpha = 1, metallic = 0, rough = 1, cutoff = 0.5;
  Alpha mode = Alpha::opaque;
  std::uint32_t normal = none, occlusion = none, glow = none, metal_rough = none;  // further pictures
  double normal_scale = 1, occlusion_strength = 1;
};

namespace {

struct FurtherPicture {
  NodeId MaterialNode::*node;
  PixelMeaning meaning;
};
constexpr FurtherPicture further[] = {{&MaterialNode::normal_picture, PixelMeaning::data},
                                      {&MaterialNode::occlusion_picture, PixelMeaning::data},
                                      {&MaterialNode::emissive_picture, PixelMeaning::color},
                                      {&MaterialNode::metallic_roughness_picture, PixelMeaning::data}};

}  // namespace

bool Materials::has_picture(NodeId appearance) {
  if (!scene_.is(appearance, nodes::Appearance)) return false;
  const auto [i, is_new] = pictured_.try_emplace(appearance.value);
  if (is_new) i->second = find_picture(appearance);
  return i->second;
}

bool Materials::find_picture(NodeId appearance) {
  if (textures_.get(scene_.get(appearance, nodes::appearance::texture)).texture != none) return true;
  const auto m = material_of(scene_, appearance);
  return m &&
         std::ranges::any_of(further, [&](auto f) { return textures_.get((*m).*f.node, f.meaning).texture != none; });
}

MaterialUse Materials::get(NodeId appearance, SurfaceKind s) {
  std::uint64_t key = appearance.value;
  for (bool b : {s.faces, s.color, s.texcoord, s.light, s.double_sided, s.opacity}) key = key << 1 | b;
  auto [i, is_new] = uses_.try_emplace(key);
  if (is_new) i->second = make(appearance, s);
  return i->second;
}

MaterialUse Materials::make(NodeId appearance, SurfaceKind s) {
  Look l = look(appearance, s);
  bool bake = l.texture.texture != none && !uv_transform(l.uv);
  const std::string text = json(l);
  const bool moving = moves(l), moving_picture = moves_picture(l);
  const std::string source = (moving ? std::to_string(l.material.value) : "") +
                             (moving_picture ? "/" + std::to_string(l.transform_node.value) : "");
  auto [i, is_new] = by_json_.try_emplace(text + source, static_cast<std::uint32_t>(materials_.size()));
  if (is_new) materials_.push_back(text);
  if (is_new && (moving || moving_picture))
    moved_.push_back({i->second, l.material, l.base, l.emissive, l.alpha, l.base_field, l.shows_alpha,
                      l.surface.faces && l.lit && !replaced_by_light(l), l.lit,
                      moving_picture ? l.transform_node : NodeId{}, mapped(l)});
  bool light = l.light.texture != none, bake_light = light && !uv_transform(l.light_uv);
  return {i->second, bake ? l.transform_node : NodeId{}, light, bake_light ? l.light_transform : NodeId{},
          l.shows_color};
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
  l.says = wrlkit::read_material(scene_, l.material);
  if (!l.says) l.material = {};
  if (!scene_.is(l.transform_node, nodes::TextureTransform)) l.transform_node = {};
  if (s.faces && s.texcoord) {
    l.texture = textures_.get(l.texture_node);
    further_pictures(l);
  }
  if (s.faces && s.texcoord) l.uv = read_texture_transform(scene_, l.transform_node).map();
  read_material(l);
  if (l.alpha < 1 || (s.color && s.opacity) || moves(l, "transparency")) l.mode = Alpha::blend;
  if (l.texture.channels % 2 == 0 && l.texture.channels > 0) {
    const bool multiplies = l.appearance && multiplies_picture(scene_, l.appearance);
    if (!multiplies || l.mode == Alpha::opaque) l.mode = l.texture.alpha;
    if (!multiplies) l.alpha = 1;
    l.shows_alpha = multiplies;
  }
  read_alpha_mode(l);
  if (l.appearance && s.faces && s.light) look_at_light(l);
  return l;
}

void Materials::read_material(Look& l) {
  const SurfaceKind& s = l.surface;
  const bool replaced = l.texture.channels >= 3 && !(l.appearance && multiplies_picture(scene_, l.appearance));
  l.shows_color = s.color && !replaced;
  if (!l.says) return;
  const MaterialNode& m = *l.says;
  const bool physical = m.kind == MaterialNode::Kind::physical, unlit = m.kind == MaterialNode::Kind::unlit;
  l.lit = s.faces && !unlit;
  if (!s.color && !replaced) {
    l.base = s.faces ? m.color : m.emissive;
    l.base_field = unlit || (!s.faces && !physical) ? "emissiveColor" : physical ? "baseColor" : "diffuseColor";
  }
  if (l.lit) l.emissive = m.emissive;
  l.alpha = 1 - unit_range(m.transparency);
  if (physical) {
    l.metallic = unit_range(m.metallic);
    l.rough = unit_range(m.roughness);
  } else if (l.lit) {
    l.rough = roughness(m.shininess, m.specular);
  }
}

void Materials::read_alpha_mode(Look& l) {
  if (!l.appearance) return;
  const auto mode = scene_.get(l.appearance, nodes::appearance::alphaMode);
  if (mode == "OPAQUE") {
    l.mode = Alpha::opaque;
    l.alpha = 1;
    l.shows_alpha = false;
  }
  if (mode == "BLEND") l.mode = Alpha::blend;
  if (mode == "MASK") {
    l.mode = Alpha::mask;
    l.cutoff = unit_range(scene_.get(l.appearance, nodes::appearance::alphaCutoff));
  }
}

void Materials::further_pictures(Look& l) {
  if (!l.says) return;
  std::uint32_t* to[] = {&l.normal, &l.occlusion, &l.glow, &l.metal_rough};
  for (std::size_t i = 0; i < std::size(further); ++i)
    *to[i] = textures_.get((*l.says).*further[i].node, further[i].meaning).texture;
  l.normal_scale = l.says->normal_scale;
  l.occlusion_strength = unit_range(l.says->occlusion_strength);
}

void Materials::look_at_light(Look& l) {
  using As = GltfOptions::Lightmaps;
  namespace a = nodes::appearance;
  NodeId lightmap = scene_.get(l.appearance, a::lightmap);
  l.light = lightmaps_ == As::occlusion ? textures_.brightness(lightmap, scene_.get(l.appearance, a::lightmapScale))
                                        : textures_.get(lightmap);
  if (l.light.texture == none) return;
  l.light_transform = scene_.get(l.appearance, a::lightmapTransform);
  if (!scene_.is(l.light_transform, nodes::TextureTransform)) l.light_transform = {};
  l.light_uv = read_texture_transform(scene_, l.light_transform).map();
  if (lightmaps_ == As::occlusion) l.occlusion = none;
  if (lightmaps_ != As::emissive) return;
  for (std::string_view field : {l.base_field, std::string_view("emissiveColor")}) outshine(l, field);
  l.base = black;
  l.emissive = white;
  l.shows_color = false;
  l.glow = none;
  l.base_field = {};
  if (l.texture.channels % 2 == 1) l.texture = {};
}

bool Materials::moves(const Look& l, std::string_view field) const {
  auto slot = l.material && !field.empty() ? scene_.type(l.material).find(field, Dialect::x3d) : std::nullopt;
  return slot && motion_.moves(l.material, *slot);
}

void Materials::outshine(const Look& l, std::string_view field) {
  if (moves(l, field)) outshone_.insert({l.material.value, *scene_.type(l.material).find(field, Dialect::x3d)});
}

bool Materials::moves(const Look& l) const {
  constexpr std::string_view fields[] = {"emissiveColor", "specularColor", "shininess", "metallic", "roughness"};
  return moves(l, l.base_field) || (l.shows_alpha && moves(l, "transparency")) ||
         (l.lit && std::ranges::any_of(fields, [&](auto f) { return moves(l, f); }));
}

bool Materials::moves_picture(const Look& l) const {
  namespace t = nodes::texture_transform;
  return l.transform_node && l.texture.texture != none && uv_transform(l.uv) &&
         std::ranges::any_of(std::array{t::center.slot, t::scale.slot, t::rotation.slot, t::translation.slot},
                             [&](auto slot) { return motion_.moves(l.transform_node, slot); });
}

/// The pictures that have the TextureTransform.
std::vector<std::string_view> Materials::mapped(const Look& l) {
  std::vector<std::string_view> out{"pbrMetallicRoughness/baseColorTexture"};
  if (!l.lit) return out;
  if (l.metal_rough != none) out.push_back("pbrMetallicRoughness/metallicRoughnessTexture");
  if (l.normal != none) out.push_back("normalTexture");
  if (l.occlusion != none) out.push_back("occlusionTexture");
  if (l.glow != none) out.push_back("emissiveTexture");
  return out;
}

bool Materials::replaced_by_light(const Look& l) const {
  return l.light.texture != none && lightmaps_ == GltfOptions::Lightmaps::emissive;
}

std::string Materials::json(const Look& l) {
  std::string text;
  JsonOut json(text);
  json.begin_object();
  auto name_of = [&](NodeId n) { return !n ? std::string_view{} : extras_ ? extras_->name(n) : scene_.name(n); };
  auto name = name_of(l.material).empty() ? name_of(l.appearance) : name_of(l.material);
  if (!name.empty()) json.member("name", name);
  pbr(json, l);
  if (l.normal != none && l.lit) texture_info(json, l, "normalTexture", l.normal, "scale", l.normal_scale);
  if (l.occlusion != none && l.lit)
    texture_info(json, l, "occlusionTexture", l.occlusion, "strength", l.occlusion_strength);
  using As = GltfOptions::Lightmaps;
  if (replaced_by_light(l)) {
    json.key("emissiveTexture");
    light_info(json, l);
  }
  if (l.light.texture != none && lightmaps_ == As::occlusion) {
    json.key("occlusionTexture");
    light_info(json, l);
  }
  if (l.emissive != black || (l.lit && moves(l, "emissiveColor")))
    json.member("emissiveFactor", std::span<const float>(linear_color(l.emissive)));
  if (l.glow != none && l.lit) texture_info(json, l, "emissiveTexture", l.glow);
  if (l.mode != Alpha::opaque) json.member("alphaMode", l.mode == Alpha::mask ? "MASK" : "BLEND");
  if (l.mode == Alpha::mask && l.cutoff != 0.5) json.member("alphaCutoff", static_cast<float>(l.cutoff));
  if (l.surface.double_sided) json.member("doubleSided", true);
  extensions(json, l);
  extras(json, l);
  json.end_object();
  return text;
}

void Materials::extensions(JsonOut& json, const Look& l) {
  const bool moz = l.light.texture != none && lightmaps_ == GltfOptions::Lightmaps::moz;
  const bool unlit = !l.lit && !replaced_by_light(l);
  if (!unlit && !moz) return;
  json.object("extensions", [&] {
    if (unlit) {
      json.member("KHR_materials_unlit", JsonText{"{}"});
      unlit_ = true;
    }
    if (moz) {
      json.key("MOZ_lightmap");
      light_info(json, l);
      moz_lightmap_ = true;
    }
  });
}

/// The lightmap as a textureInfo; MOZ_lightmap has a factor in it, too.
void Materials::light_info(JsonOut& json, const Look& l) {
  json.object([&] {
    const double scale = scene_.get(l.appearance, nodes::appearance::lightmapScale);
    if (lightmaps_ == GltfOptions::Lightmaps::moz && scale != 1) json.member("intensity", scale);
    texture_info_members(json, l.light.texture, l.surface.texcoord, l.light_uv);
  });
}

// An unlit material has a fallback for viewers that do not know the extension: as rough as can be.
void Materials::pbr(JsonOut& json, const Look& l) {
  json.object("pbrMetallicRoughness", [&] {
    auto base = linear_color(l.base);
    if (l.base != white || l.alpha < 1 || moves(l, l.base_field) || moves(l, "transparency"))
      json.member("baseColorFactor",
                  std::span<const float>(std::array{base[0], base[1], base[2], static_cast<float>(l.alpha)}));
    if (l.texture.texture != none) texture_info(json, l, "baseColorTexture", l.texture.texture);
    json.member("metallicFactor", static_cast<float>(l.lit ? l.metallic : 0));
    if (l.lit && (l.rough < 1 || moves(l))) json.member("roughnessFactor", static_cast<float>(l.rough));
    if (l.lit && l.metal_rough != none) texture_info(json, l, "metallicRoughnessTexture", l.metal_rough);
  });
}

void Materials::texture_info(JsonOut& json, const Look& l, std::string_view name, std::uint32_t texture,
                             const char* factor, double value) {
  json.object(name, [&] {
    texture_info_members(json, texture, 0, l.uv, moves_picture(l));
    if (value != 1) json.member(factor, static_cast<float>(value));
    if (extras_ && l.transform_node) {
      json.object("extras",
                  [&] { extras_->vrml97(json, l.transform_node, {}, !extras_->name(l.transform_node).empty()); });
    }
  });
}

void Materials::texture_info_members(JsonOut& json, std::uint32_t texture, std::uint32_t set, const TexcoordMap& uv,
                                     bool moved) {
  json.member("index", texture);
  if (set > 0) json.member("texCoord", set);
  auto t = uv_transform(uv);
  if (!t || (uv == TexcoordMap{} && !moved)) return;
  texture_transform_ = true;
  json.object("extensions", [&] {
    json.object("KHR_texture_transform", [&] {
      if (moved || t->offset != Vec2{0, 0}) json.member("offset", std::span<const double>(t->offset));
      if (moved || t->rotation != 0) json.member("rotation", t->rotation);
      if (moved || t->scale != Vec2{1, 1}) json.member("scale", std::span<const double>(t->scale));
    });
  });
}

/// {index, texCoord, ..., scale, directions: [3, 4, 5]}, the latter textures as index is. Of what is written as
/// occlusion, which nobody else would take for light: {index, texCoord, ..., linear: true}.
void Materials::light_extras(JsonOut& json, const Look& l) {
  namespace a = nodes::appearance;
  json.key("lightmap");
  json.begin_object();
  texture_info_members(json, l.light.texture, l.surface.texcoord, l.light_uv);
  if (lightmaps_ == GltfOptions::Lightmaps::occlusion) {
    json.member("linear", true);
    return json.end_object();
  }
  json.member("scale", scene_.get(l.appearance, a::lightmapScale));
  std::vector<std::uint32_t> directions;
  for (NodeId n : scene_.get(l.appearance, a::lightmapDirection))
    if (auto use = textures_.get(n, PixelMeaning::data); use.texture != none) directions.push_back(use.texture);
  if (directions.size() == 3) json.member("directions", std::span<const std::uint32_t>(directions));
  json.end_object();
}

/// What glTF has expressed of a Material.
std::vector<std::uint16_t> Materials::said_by_vrml97(const Look& l) const {
  std::vector<std::uint16_t> said{m::diffuseTexture.slot,   m::normalTexture.slot, m::emissiveTexture.slot,
                                  m::occlusionTexture.slot, m::normalScale.slot,   m::occlusionStrength.slot};
  // White with a picture could be either: a white material, or one that the picture replaces.
  const bool one_color = l.surface.faces && !l.surface.color && (l.texture.channels < 3 || l.says->color_picture) &&
                         (l.texture.texture == none || l.base != white);
  if (one_color && !replaced_by_light(l)) said.push_back(m::diffuseColor.slot);
  if (!replaced_by_light(l) && (l.surface.faces || !l.surface.color)) said.push_back(m::emissiveColor.slot);
  const bool is_opaque = l.appearance && scene_.get(l.appearance, nodes::appearance::alphaMode) == "OPAQUE";
  if (l.shows_alpha && !is_opaque) said.push_back(m::transparency.slot);
  return said;
}

/// What glTF has expressed of a material that only X3D has.
std::vector<std::uint16_t> Materials::said_by_x3d(const Look& l) const {
  namespace p = nodes::physical_material;
  namespace u = nodes::unlit_material;
  if (scene_.is(l.material, nodes::UnlitMaterial))
    return {u::emissiveColor.slot, u::transparency.slot, u::emissiveTexture.slot};
  return {p::baseColor.slot,         p::emissiveColor.slot,
          p::metallic.slot,          p::roughness.slot,
          p::transparency.slot,      p::normalScale.slot,
          p::occlusionStrength.slot, p::baseTexture.slot,
          p::emissiveTexture.slot,   p::metallicRoughnessTexture.slot,
          p::normalTexture.slot,     p::occlusionTexture.slot};
}

/// Slots of an Appearance that the material, its textures and its alphaMode say.
std::vector<std::uint16_t> Materials::said_by_appearance(const Look& l) {
  namespace a = nodes::appearance;
  std::vector<std::uint16_t> said{a::texture.slot, a::alphaMode.slot, a::alphaCutoff.slot, a::backMaterial.slot};
  if (l.material) said.push_back(a::material.slot);
  if (l.transform_node) said.push_back(a::textureTransform.slot);
  return said;
}

/// The fields of a material that the look does not show, a picture that is not shown at all, and the light.
void Materials::extras(JsonOut& json, const Look& l) {
  std::vector<std::uint16_t> said;
  if (l.material) said = scene_.is(l.material, nodes::Material) ? said_by_vrml97(l) : said_by_x3d(l);
  // White and unlit is what a Shape without a Material is, too; what is rough may be of a Material.
  bool material = extras_ && l.material &&
                  (extras_->anything(l.material, said) || scene_.is(l.material, nodes::PhysicalMaterial) ||
                   (!l.lit && l.base == white && l.alpha == 1));
  const auto alpha_mode = l.appearance ? scene_.get(l.appearance, nodes::appearance::alphaMode) : std::string_view();
  const bool says_alpha = extras_ && !alpha_mode.empty() && alpha_mode != "AUTO";
  const bool named = extras_ && l.appearance && !extras_->name(l.appearance).empty();
  const auto said_of_look = said_by_appearance(l);
  const bool says_more = extras_ && l.appearance && extras_->anything(l.appearance, said_of_look);
  bool picture = extras_ && l.texture_node && l.texture.texture == none;
  bool transform = extras_ && l.transform_node && l.texture.texture == none;
  // For a Material alone: a picture that is multiplied, not one that takes the place of the colour.
  bool multiplied =
      extras_ && l.texture.texture != none && scene_.is(l.material, nodes::Material) && l.says->color_picture;
  using As = GltfOptions::Lightmaps;
  const bool light = l.light.texture != none && (lightmaps_ == As::extras || lightmaps_ == As::occlusion);
  for (NodeId n : {l.appearance, l.material, l.texture.texture == none ? NodeId{} : l.texture_node})
    if (n && extras_) extras_->set_placed(n);
  if (!material && !picture && !named && !says_more && !says_alpha && !transform && !multiplied && !light) return;
  json.object("extras", [&] {
    if (light) light_extras(json, l);
    if (material || picture || named || says_more || says_alpha || transform || multiplied) {
      json.object("vrml97", [&] {
        if (named || says_alpha || says_more)
          json.object("Appearance", [&] {
            if (named) json.member("DEF", extras_->name(l.appearance));
            if (says_alpha) json.member("alphaMode", alpha_mode);
            if (says_more) extras_->other_fields(json, l.appearance, said_of_look);
          });
        if (multiplied) json.member("multiplied", true);
        if (material) extras_->node(json, l.material, said);
        if (picture) extras_->node(json, l.texture_node, {}, !extras_->name(l.texture_node).empty());
        if (transform) extras_->node(json, l.transform_node, {}, !extras_->name(l.transform_node).empty());
      });
    }
  });
}

}  // namespace wrlkit::gltf
