#include "parsers/gltf/materials.h"

#include <algorithm>
#include <cmath>

#include "scenegraph/equal.h"
#include "scenegraph/looks/shininess.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf_reader {
namespace {

constexpr Vec3 white{1, 1, 1}, black{0, 0, 0};

/// Sets a field away from its default.
template <FieldType T, class V>
void set(Scene& scene, NodeId n, FieldKey<T> key, const V& v) {
  Value made = scene.make(T, key.slot, v);
  if (!equal_plain(made, scene.type(n).fields[key.slot].default_value)) scene.set(n, made);
}

/// Three or four numbers of an array, or the fallback.
template <std::size_t N>
std::array<double, N> vector(Json j, std::array<double, N> fallback) {
  auto v = j.numbers();
  if (v.size() == N) std::ranges::copy(v, fallback.begin());
  return fallback;
}

Vec3 display_color(const Vec3& l) { return {display(l[0]), display(l[1]), display(l[2])}; }

double unit_range(double v) { return v >= 0 ? std::min(v, 1.0) : 0.0; }

std::optional<TexcoordMap> inverse(const TexcoordMap& a) {
  const double d = a.determinant();
  if (!(std::abs(d) > 0) || !std::isfinite(1 / d)) return std::nullopt;
  TexcoordMap b{a.yy / d, -a.xy / d, -a.yx / d, a.xx / d, 0, 0};
  b.x = -(b.xx * a.x + b.xy * a.y);
  b.y = -(b.yx * a.x + b.yy * a.y);
  return b;
}

/// The coordinates of glTF count from the top: the map between them is flipped on both sides.
TexcoordMap affine_of(Json transform) {
  auto offset = vector<2>(transform["offset"], {0, 0}), scale = vector<2>(transform["scale"], {1, 1});
  double r = transform["rotation"].number(), c = std::cos(r), s = std::sin(r);
  double xx = c * scale[0], xy = s * scale[1], yx = -s * scale[0], yy = c * scale[1];
  return {xx, -xy, -yx, yy, xy + offset[0], 1 - yy - offset[1]};
}

/// Index n of the TEXCOORD_n that a textureInfo means.
std::optional<std::uint32_t> set_of(Json info) {
  if (!info) return std::nullopt;
  const Json moved = info["extensions"]["KHR_texture_transform"]["texCoord"];
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>((moved ? moved : info["texCoord"]).whole().value_or(0), 99));
}

/// Black but for a picture that shines is all that glTF has for light and colour in one picture: a white surface that
/// has that light.
bool shines_as_picture(Json material) {
  const Json pbr = material["pbrMetallicRoughness"];
  const auto base = vector<4>(pbr["baseColorFactor"], {1, 1, 1, 1});
  return material["emissiveTexture"] && !pbr["baseColorTexture"] && Vec3{base[0], base[1], base[2]} == black &&
         vector<3>(material["emissiveFactor"], black) == white;
}

/// Linear.
Vec3 emission_of(Json material) {
  Vec3 out = vector<3>(material["emissiveFactor"], black);
  const double strength = material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].number(1);
  for (double& e : out) e *= strength;
  return out;
}

/// The field for a picture that is multiplied by the colour.
std::uint16_t picture_slot(const Scene& scene, NodeId material) {
  return scene.is(material, nodes::Material)           ? nodes::material::diffuseTexture.slot
         : scene.is(material, nodes::PhysicalMaterial) ? nodes::physical_material::baseTexture.slot
                                                       : nodes::unlit_material::emissiveTexture.slot;
}

Json lightmap_of(Json material) {
  const Json moz = material["extensions"]["MOZ_lightmap"];
  if (moz) return moz;
  return shines_as_picture(material) ? material["emissiveTexture"] : material["extras"]["lightmap"];
}

}  // namespace

std::optional<std::uint32_t> Materials::texcoord_set(std::uint32_t material) const {
  return set_of(c_.file.at(Table::materials, material)["pbrMetallicRoughness"]["baseColorTexture"]);
}

std::optional<std::uint32_t> Materials::light_set(std::uint32_t material) const {
  const Json light = lightmap_of(c_.file.at(Table::materials, material));
  return light["index"] ? set_of(light) : std::nullopt;
}

bool Materials::is_light(std::uint32_t material) const {
  return shines_as_picture(c_.file.at(Table::materials, material));
}

const Look& Materials::get(std::uint32_t material, SurfaceKind s) {
  auto [i, is_new] = looks_.try_emplace({material, s});
  if (is_new) i->second = make(material, s);
  return i->second;
}

std::vector<std::pair<NodeId, bool>> Materials::nodes_of(std::uint32_t material) const {
  std::vector<std::pair<NodeId, bool>> out;
  for (const auto& [key, look] : looks_) {
    const NodeId n = std::get<0>(key) == material && look.appearance
                         ? c_.scene.get(look.appearance, nodes::appearance::material)
                         : NodeId{};
    if (c_.scene.is(n, nodes::Material) && std::ranges::find(out, n, &std::pair<NodeId, bool>::first) == out.end())
      out.emplace_back(n, std::get<1>(key).faces);
  }
  return out;
}

Look Materials::make(std::uint32_t index, SurfaceKind s) {
  Look look;
  const Json m = c_.file.at(Table::materials, index);
  if (!m) return look;
  look.double_sided = m["doubleSided"].boolean();
  const Json extras = vrml97(m), info = m["pbrMetallicRoughness"]["baseColorTexture"];
  auto texture_index =
      s.faces && (s.given_texcoord || c_.file.is_whole()) ? c_.file.index(Table::textures, info["index"]) : none;
  NodeId picture = texture_index == none ? NodeId{} : texture(texture_index);
  NodeId transform = picture ? texture_transform(info, s, look) : NodeId{};
  look.textured = bool(picture);
  look.texcoord = texcoord_set(index).value_or(0);
  const bool shown_by_light = s.light && shines_as_picture(m);
  if (c_.file.is_own() && !picture && !shown_by_light)  // one that could not be shown
    for (std::string_view type : {"ImageTexture", "PixelTexture", "MovieTexture", "TextureTransform"})
      if (extras[type]) {
        NodeId n = c_.add(find_builtin(type, Dialect::vrml97), extras[type]);
        extras_.fields(n, extras[type]);
        c_.set_name(n, extras[type]["DEF"]);
        (type == "TextureTransform" ? transform : picture) = n;
      }
  NodeId material = material_node(m, s, look);
  const bool multiplied = picture && material && is_multiplied(m, s, material);
  if (multiplied) c_.scene.set(material, c_.scene.make(FieldType::SFNode, picture_slot(c_.scene, material), picture));
  // What has no name of its own is called by that of the Material, or of the Appearance; wrlkit says which.
  const bool apart = c_.file.is_own() && (material || c_.file.is_whole());
  const Json name = apart ? extras["Appearance"]["DEF"] : m["name"];
  if (material && apart && name.text() != m["name"].text()) {
    c_.set_name(material, m["name"]);
    material = same_named(material, c_.scene.type_id(material));
  }
  if (!material && !picture && !name && !extras["Appearance"]) return look;
  look.appearance = c_.add(nodes::Appearance, m);
  if (material) c_.scene.set(look.appearance, nodes::appearance::material, material);
  if (picture && !multiplied) c_.scene.set(look.appearance, nodes::appearance::texture, picture);
  if (transform) c_.scene.set(look.appearance, nodes::appearance::textureTransform, transform);
  if (const Json alpha = extras["Appearance"]["alphaMode"]; alpha && c_.file.is_whole()) {
    c_.scene.set(look.appearance, nodes::appearance::alphaMode, alpha.text());
    if (const Json cutoff = m["alphaCutoff"])
      c_.scene.set(look.appearance, nodes::appearance::alphaCutoff, cutoff.number(0.5));
  }
  if (c_.file.is_whole())
    extras_.fields(look.appearance, extras["Appearance"]);
  else if (c_.file.is_own())
    extras_.tags(look.appearance, extras["Appearance"]);
  if (s.light) set_light(look.appearance, m);
  c_.set_name(look.appearance, name);
  look.appearance = same_named(look.appearance, nodes::Appearance);
  if (material) extras_.define(material);
  if (picture) extras_.define(picture);
  if (transform) extras_.define(transform);
  extras_.define(look.appearance);
  if (!c_.file.is_whole()) report_lost(m);
  return look;
}

/// glTF multiplies a picture by the colour, VRML97 shows the picture: then it is one of the material, as in X3D 4.0.
bool Materials::is_multiplied(Json m, SurfaceKind s, NodeId material) const {
  const bool unlit = !c_.scene.is(material, nodes::Material);  // or physical
  if (c_.file.is_whole()) return unlit || vrml97(m)["multiplied"].boolean();
  const auto factor = vector<4>(m["pbrMetallicRoughness"]["baseColorFactor"], {1, 1, 1, 1});
  return (s.color && !c_.file.is_own()) || unlit || Vec3{factor[0], factor[1], factor[2]} != white;
}

/// One node for a name where several materials of glTF are one of VRML, on different kinds of surfaces.
NodeId Materials::same_named(NodeId n, TypeId type) {
  if (c_.scene.name(n).empty()) return n;
  auto [i, is_new] = named_.try_emplace({type.value, std::string(c_.scene.name(n))}, n);
  if (is_new) return n;
  auto a = c_.scene.fields(i->second), b = c_.scene.fields(n);
  auto same = [](const Value& x, const Value& y) {
    return x.slot == y.slot && x.type == y.type &&
           (info(x.type).element == Element::node ? x.node == y.node : equal_plain(x, y));
  };
  return std::ranges::equal(a, b, same) ? i->second : n;
}

NodeId Materials::material_node(Json m, SurfaceKind s, Look& look) {
  const bool unlit = bool(m["extensions"]["KHR_materials_unlit"]), own = c_.file.is_whole();
  const Json extras = vrml97(m)["Material"], physical = vrml97(m)["PhysicalMaterial"];
  const auto factor = vector<4>(m["pbrMetallicRoughness"]["baseColorFactor"], {1, 1, 1, 1});
  const Vec3 rgb{factor[0], factor[1], factor[2]};
  if (own && physical && s.faces) return physical_node(m, physical, s, look);
  if (s.color && !own) look.color_factor = rgb;
  // Unlit and white, of its Color, or of its picture: that is a Shape without a Material (tables 4.5 and 4.6).
  const bool plain = rgb == white || s.color || look.textured;
  if ((unlit || !s.faces) && plain && (factor[3] >= 1 || look.textured) && !extras) {
    if (factor[3] >= 1 && (!look.textured || (rgb == white && (own || !s.color)))) return {};
    namespace u = nodes::unlit_material;
    const NodeId n = c_.add(nodes::UnlitMaterial, m);
    set(c_.scene, n, u::emissiveColor, s.color ? white : display_color(rgb));
    set(c_.scene, n, u::transparency, transparency_of(m, look));
    return n;
  }
  NodeId n = c_.add(nodes::Material, m);
  if (s.light && shines_as_picture(m)) {
    c_.scene.set(n, nodes::material::diffuseColor, white);
    set(c_.scene, n, nodes::material::transparency, transparency_of(m, look));
    return n;
  }
  set_color(n, m, s, look);
  if (s.faces && !unlit && !own) set_highlight(n, m);
  if (own && s.faces && !unlit) set_further_pictures(n, m);
  if (own) extras_.fields(n, extras);
  return n;
}

/// Of the metal and roughness of glTF, whose colours are linear, as its own.
NodeId Materials::physical_node(Json m, Json kept, SurfaceKind s, const Look& look) {
  namespace p = nodes::physical_material;
  const Json pbr = m["pbrMetallicRoughness"];
  const auto factor = vector<4>(pbr["baseColorFactor"], {1, 1, 1, 1});
  const NodeId n = c_.add(nodes::PhysicalMaterial, m);
  if (!s.color) set(c_.scene, n, p::baseColor, Vec3{factor[0], factor[1], factor[2]});
  set(c_.scene, n, p::emissiveColor, emission_of(m));
  set(c_.scene, n, p::metallic, unit_range(pbr["metallicFactor"].number(1)));
  set(c_.scene, n, p::roughness, unit_range(pbr["roughnessFactor"].number(1)));
  set(c_.scene, n, p::transparency, transparency_of(m, look));
  set_further_pictures(n, m);
  extras_.fields(n, kept);
  return n;
}

/// Those that X3D 4.0 has by the names of glTF.
void Materials::set_further_pictures(NodeId n, Json m) {
  const auto slot_of = [&](std::string_view field) { return c_.scene.type(n).find(field, Dialect::x3d); };
  const auto put = [&](std::string_view field, Json info) {
    const auto index = info ? c_.file.index(Table::textures, info["index"]) : none;
    const NodeId picture = index == none || !slot_of(field) ? NodeId{} : texture(index);
    if (!picture) return;
    c_.scene.set(n, c_.scene.make(FieldType::SFNode, *slot_of(field), picture));
    extras_.define(picture);
  };
  const auto put_factor = [&](std::string_view field, Json factor) {
    if (factor && slot_of(field)) c_.scene.set(n, c_.scene.make(FieldType::SFFloat, *slot_of(field), factor.number(1)));
  };
  put("normalTexture", m["normalTexture"]);
  const bool is_light = m["extras"]["lightmap"]["linear"].boolean();
  if (!is_light) put("occlusionTexture", m["occlusionTexture"]);
  if (!shines_as_picture(m)) put("emissiveTexture", m["emissiveTexture"]);
  put("metallicRoughnessTexture", m["pbrMetallicRoughness"]["metallicRoughnessTexture"]);
  put_factor("normalScale", m["normalTexture"]["scale"]);
  if (!is_light) put_factor("occlusionStrength", m["occlusionTexture"]["strength"]);
}

void Materials::set_color(NodeId n, Json m, SurfaceKind s, Look& look) {
  namespace f = nodes::material;
  const bool unlit = bool(m["extensions"]["KHR_materials_unlit"]), own = c_.file.is_whole();
  const Json factor_json = m["pbrMetallicRoughness"]["baseColorFactor"];
  const auto factor = vector<4>(factor_json, {1, 1, 1, 1});
  const Vec3 base = display_color({factor[0], factor[1], factor[2]});
  const bool said = !own || (!s.color && !(look.textured && base == white));
  if (unlit || !s.faces) {
    if (s.faces) set(c_.scene, n, f::diffuseColor, black);
    if (said) set(c_.scene, n, f::emissiveColor, base);
  } else {
    if (said) set(c_.scene, n, f::diffuseColor, base);
    // A picture of what shines is lost: its factor would make all of the surface shine.
    if (!m["emissiveTexture"] || own) set(c_.scene, n, f::emissiveColor, display_color(emission_of(m)));
  }
  set(c_.scene, n, f::transparency, transparency_of(m, look));
}

double Materials::transparency_of(Json m, const Look& look) {
  const auto factor = vector<4>(m["pbrMetallicRoughness"]["baseColorFactor"], {1, 1, 1, 1});
  const auto mode = m["alphaMode"].text("OPAQUE");
  double alpha = mode == "OPAQUE" ? 1 : unit_range(factor[3]);
  const bool is_cut_as_said = bool(vrml97(m)["Appearance"]["alphaMode"]);  // by alphaCutoff of X3D
  if (mode == "MASK" && !look.textured && !is_cut_as_said) alpha = alpha >= m["alphaCutoff"].number(0.5) ? 1 : 0;
  const auto single = static_cast<float>(alpha);
  return shortest(1 - alpha, [&](double d) { return static_cast<float>(1 - d) == single; });
}

void Materials::set_highlight(NodeId n, Json m) {
  namespace f = nodes::material;
  constexpr double peak = 0.01;
  const Json pbr = m["pbrMetallicRoughness"], kept = vrml97(m)["Material"];
  const double r = unit_range(pbr["roughnessFactor"].number(1)), metallic = unit_range(pbr["metallicFactor"].number(1));
  const double wide = std::max(r * r * r * r, 1e-6), bright = unit_range(peak / wide);
  const auto base = vector<4>(pbr["baseColorFactor"], {1, 1, 1, 1});
  if (kept && metallic == 0) {  // another program has changed the file, but perhaps not this
    auto specular = vector<3>(kept["specularColor"], black);
    const double s = unit_range(std::max({specular[0], specular[1], specular[2]})),
                 shininess = unit_range(kept["shininess"].number(0.2));
    const double expected = s <= peak ? 1 : std::pow(std::max(highlight_width(shininess), peak / s), 0.25);
    if (std::abs(expected - r) < 1e-4) return extras_.fields(n, kept);
  }
  if (r >= 1 || bright <= peak) return;
  Vec3 specular;
  for (std::size_t i = 0; i < 3; ++i) specular[i] = bright * (1 - metallic) + bright * metallic * display(base[i]);
  auto rounded = [](double v) { return std::round(v * 1e6) / 1e6; };
  set(c_.scene, n, f::specularColor, Vec3{rounded(specular[0]), rounded(specular[1]), rounded(specular[2])});
  set(c_.scene, n, f::shininess, rounded(unit_range(shininess_of_width(wide))));
}

// ---- places in pictures, and light ---------------------------------------------------------------------------------

NodeId Materials::texture_transform(Json info, SurfaceKind s, Look& look) {
  namespace f = nodes::texture_transform;
  const Json kept = vrml97(info)["TextureTransform"], said = info["extensions"]["KHR_texture_transform"];
  if (c_.file.is_whole() && kept) {
    NodeId n = c_.add(nodes::TextureTransform, kept);
    extras_.fields(n, kept);
    c_.set_name(n, kept["DEF"]);
    if (said || !s.given_texcoord) return n;
    look.bake = inverse(
        read_texture_transform(c_.scene, n).map());  // it was applied to the coordinates, and is taken from them again
    return look.bake ? n : NodeId{};
  }
  const TexcoordMap a = affine_of(said);
  if (!said || a == TexcoordMap{}) return {};
  const NodeId n = transform_node(a, said);
  if (!n) look.bake = a;
  if (n && c_.file.is_own()) extras_.tags(n, kept);
  return n;
}

/// Null where VRML cannot express it.
NodeId Materials::transform_node(const TexcoordMap& a, Json said) {
  namespace f = nodes::texture_transform;
  const auto fields = texture_transform_of(a);
  if (!fields) return {};
  const NodeId n = c_.add(nodes::TextureTransform, said);
  set(c_.scene, n, f::scale, fields->scale);
  set(c_.scene, n, f::rotation, fields->rotation);
  set(c_.scene, n, f::translation, fields->translation);
  return n;
}

/// `intensity` of MOZ_lightmap and `scale` of extras.lightmap are lightmapScale. `linear` of the latter: the picture is
/// that of an occlusionTexture.
void Materials::set_light(NodeId appearance, Json m) {
  namespace a = nodes::appearance;
  const Json light = lightmap_of(m), said = light["extensions"]["KHR_texture_transform"];
  auto picture = [&](Json number) {
    const auto index = c_.file.index(Table::textures, number);
    if (index == none) return NodeId{};
    return light["linear"].boolean() ? light_of_linear(index) : texture(index);
  };
  const NodeId map = picture(light["index"]);
  if (!map) return;
  c_.scene.set(appearance, a::lightmap, map);
  set(c_.scene, appearance, a::lightmapScale, (light["intensity"] ? light["intensity"] : light["scale"]).number(1));
  std::vector<NodeId> directions;
  for (Json d : light["directions"].elements())
    if (const NodeId n = picture(d)) directions.push_back(n);
  if (directions.size() == 3) c_.scene.set(appearance, a::lightmapDirection, directions);
  if (const TexcoordMap moved = affine_of(said); said && moved != TexcoordMap{}) {
    const NodeId n = transform_node(moved, said);
    if (n)
      c_.scene.set(appearance, a::lightmapTransform, n);
    else
      c_.lost.add("KHR_texture_transform of a lightmap", c_.file.where(said));
  }
}

void Materials::report_lost(Json m) {
  const Span where = c_.file.where(m);
  if (!reported_.insert(m.offset()).second) return;
  for (std::string_view t : {"normalTexture", "occlusionTexture", "emissiveTexture"})
    if (m[t] && !(t == "emissiveTexture" && shines_as_picture(m))) c_.lost.add(t, where);
  const Json pbr = m["pbrMetallicRoughness"];
  if (pbr["metallicRoughnessTexture"]) c_.lost.add("metallicRoughnessTexture", where);
  if (pbr["metallicFactor"].number(1) > 0 && !m["extensions"]["KHR_materials_unlit"])
    c_.lost.add("metallicFactor", where);
  if (pbr["baseColorTexture"] && vector<4>(pbr["baseColorFactor"], {1, 1, 1, 1})[3] < 1 &&
      m["alphaMode"].text() == "BLEND")
    c_.lost.add("alpha of baseColorFactor with a picture", where);
  if (m["alphaMode"].text() == "MASK") c_.lost.add("alphaMode MASK", where);
  c_.lost.keep(c_.file, m);
}

}  // namespace wrlkit::gltf_reader
