#include "passes/lower_vrml1/look.h"

#include <cmath>

#include "passes/lower_vrml1/strokes.h"
#include "scenegraph/nodes.h"

namespace wrlkit::vrml1 {
namespace {

namespace v1 = nodes::vrml1;
namespace m = nodes::vrml1::material;

/// The k-th value of a list of a palette: behind its end its last one.
std::span<const double> at(std::span<const double> list, std::size_t k, std::size_t arity) {
  const std::size_t n = list.size() / arity;
  return list.subspan(std::min(k, n - 1) * arity, arity);
}

void unpack(std::span<const std::int32_t> packed, std::vector<double>& rgb, std::vector<double>& transparency) {
  constexpr double full = 255;
  for (std::int32_t p : packed) {
    const auto u = static_cast<std::uint32_t>(p);
    for (int shift : {24, 16, 8}) rgb.push_back(std::round((u >> shift & 0xff) / full * 1e6) / 1e6);
    transparency.push_back(std::round((1 - (u & 0xff) / full) * 1e6) / 1e6);
  }
}

}  // namespace

Vec3 Palette::color(std::size_t k) const {
  auto c = at(colors, k % size, 3);
  return {c[0], c[1], c[2]};
}

/// The list of a Material in force, or the default; a list that is empty too is the default.
std::span<const double> Looks::list(NodeId material, std::uint16_t slot) const {
  const Value* v = material ? &scene_.value(material, slot) : nullptr;
  if (!v || v->is || v->count == 0) v = &scene_.type(v1::Material).fields[slot].default_value;
  return v->number_span();
}

Palette Looks::make_palette(const State& s) const {
  Palette p;
  // Colours that need no light: nothing is given but emissiveColor.
  auto none = [&](std::uint16_t slot) {
    auto* v = s.material ? scene_.find(s.material, slot) : nullptr;
    return v && v->count == 0;
  };
  const bool precomputed = none(m::diffuseColor.slot) && none(m::ambientColor.slot) && none(m::specularColor.slot);
  p.unlit = precomputed || !s.lit;
  auto colors = list(s.material, precomputed ? m::emissiveColor.slot : m::diffuseColor.slot);
  p.colors.assign(colors.begin(), colors.end());
  std::vector<double> transparency;
  if (s.color) {
    p.colors.clear();
    if (scene_.is(s.color, v1::BaseColor)) {
      auto rgb = scene_.get(s.color, v1::base_color::rgb);
      p.colors.assign(rgb.begin(), rgb.end());
    } else if (scene_.is(s.color, v1::PackedColor))
      unpack(scene_.get(s.color, v1::packed_color::orderedRGBA), p.colors, transparency);
    else
      unpack(scene_.get(s.color, v1::vertex_property::orderedRGBA), p.colors, transparency);
    if (p.colors.empty()) p.colors = {0.8, 0.8, 0.8};
  }
  struct List {
    std::span<const double> values;
    std::size_t arity;
  };
  const List others[] = {{list(s.material, m::ambientColor.slot), 3},
                         {list(s.material, m::specularColor.slot), 3},
                         {list(s.material, m::emissiveColor.slot), 3},
                         {list(s.material, m::shininess.slot), 1},
                         {transparency.empty() ? list(s.material, m::transparency.slot) : transparency, 1}};
  p.size = p.colors.size() / 3;
  bool varied = false;
  for (auto& l : others) {
    p.size = std::max(p.size, l.values.size() / l.arity);
    auto first = l.values.first(l.arity);
    for (std::size_t i = 0; i < l.values.size(); i += l.arity)
      varied |= !std::ranges::equal(l.values.subspan(i, l.arity), first);
  }
  if (!varied || precomputed) return p;
  std::map<std::vector<double>, std::uint32_t> first_of;
  for (std::size_t k = 0; k < p.size; ++k) {
    std::vector<double> all;
    for (auto& l : others) {
      auto v = at(l.values, k, l.arity);
      all.insert(all.end(), v.begin(), v.end());
    }
    p.kind.push_back(first_of.emplace(std::move(all), static_cast<std::uint32_t>(k)).first->second);
  }
  return p;
}

const Palette& Looks::palette(const State& s) {
  const std::tuple key{s.material, s.color, s.lit};
  auto i = palettes_.find(key);
  return i == palettes_.end() ? palettes_.emplace(key, make_palette(s)).first->second : i->second;
}

NodeId Looks::color_node(const State& s) {
  auto& n = colors_[{s.material, s.color, s.lit}];
  if (n) return n;
  const auto& p = palette(s);
  const NodeId source = s.color ? s.color : s.material;
  n = scene_.add(nodes::Color, scene_.where(source));
  auto colors = p.colors;
  while (colors.size() < p.size * 3) colors.insert(colors.end(), colors.end() - 3, colors.end());
  scene_.set(n, nodes::color::color, colors);
  return n;
}

/// `picture`: one that is multiplied by the colour.
NodeId Looks::material_node(const State& s, std::size_t k, bool colored, bool strokes, NodeId picture) {
  const auto& p = palette(s);
  auto& n = materials_[{s.material, s.color, s.lit, k, colored, strokes, picture}];
  if (n) return n;
  std::vector<double> unpacked, alpha;
  if (s.color && !scene_.is(s.color, v1::BaseColor))
    unpack(scene_.is(s.color, v1::PackedColor) ? scene_.get(s.color, v1::packed_color::orderedRGBA)
                                               : scene_.get(s.color, v1::vertex_property::orderedRGBA),
           unpacked, alpha);
  const double transparency = at(alpha.empty() ? list(s.material, m::transparency.slot) : alpha, k, 1)[0];
  const bool unlit = p.unlit || strokes;
  if (unlit && picture) return n = unlit_node(s, k, colored, transparency, picture);
  if (unlit && colored) {
    if (transparency > 0)
      diag_.report(Diag::no_vrml97_value, scene_.where(s.material ? s.material : s.color), "Material", "transparency");
    return NodeId{};
  }
  const NodeId source = s.material ? s.material : s.color;
  n = scene_.add(nodes::Material, source ? scene_.where(source) : Span{});
  if (source && k == 0) scene_.set_name(n, scene_.name(source));
  scene_.set(n, nodes::material::transparency, transparency);
  auto vec = [&](std::uint16_t slot) {
    auto v = at(list(s.material, slot), k, 3);
    return Vec3{v[0], v[1], v[2]};
  };
  if (unlit) {
    // Lines show their diffuse colour; exporters that give an emissive one alone mean that.
    const bool glows = strokes && !p.unlit && !s.color && s.material &&
                       !scene_.find(s.material, m::diffuseColor.slot) && scene_.find(s.material, m::emissiveColor.slot);
    scene_.set(n, nodes::material::diffuseColor, Vec3{0, 0, 0}, nodes::material::emissiveColor,
               glows ? vec(m::emissiveColor.slot) : p.color(k));
    return n;
  }
  const Vec3 diffuse = p.color(k), ambient = vec(m::ambientColor.slot);
  // Files that leave ambientColor out do not define it.
  const double brightness = diffuse[0] + diffuse[1] + diffuse[2], dim = ambient[0] + ambient[1] + ambient[2];
  if (s.material && scene_.find(s.material, m::ambientColor.slot) && brightness > 0)
    scene_.set(n, nodes::material::ambientIntensity, std::round(std::clamp(dim / brightness, 0.0, 1.0) * 1e6) / 1e6);
  if (!colored) scene_.set(n, nodes::material::diffuseColor, diffuse);
  scene_.set(n, nodes::material::specularColor, vec(m::specularColor.slot), nodes::material::emissiveColor,
             vec(m::emissiveColor.slot), nodes::material::shininess, at(list(s.material, m::shininess.slot), k, 1)[0]);
  if (picture) scene_.set(n, nodes::material::diffuseTexture, picture);
  return n;
}

/// VRML97 has nothing that is not lit and has a colour and a picture.
NodeId Looks::unlit_node(const State& s, std::size_t k, bool colored, double transparency, NodeId picture) {
  namespace u = nodes::unlit_material;
  const NodeId source = s.material ? s.material : s.color;
  const NodeId n = scene_.add(nodes::UnlitMaterial, source ? scene_.where(source) : Span{});
  if (!colored) scene_.set(n, u::emissiveColor, palette(s).color(k));
  scene_.set(n, u::emissiveTexture, picture);
  if (transparency > 0) scene_.set(n, u::transparency, transparency);
  return n;
}

NodeId Looks::appearance(const State& s, std::size_t k, bool colored, bool strokes, bool baked) {
  const NodeId texture = texture_node(s.texture);
  // A picture is multiplied by the colour, as one of a material is in X3D 4.0; that of an Appearance takes its place
  // (picture_color.h).
  const auto model = texture ? scene_.get(s.texture, v1::texture2::model) : std::string_view{};
  const bool mixes = texture && !strokes && (colored || palette(s).color(k) != Vec3{1, 1, 1}),
             product = mixes && model == "MODULATE";
  const NodeId material = material_node(s, k % palette(s).size, colored, strokes, product ? texture : NodeId{});
  const auto map = texture && !baked ? s.texture_transform : 0;
  const NodeId style = strokes ? s.draw_style : NodeId{};
  auto& n = appearances_[{material, texture, map, style}];
  if (n) return n;
  if ((mixes && !product) || model == "BLEND")
    diag_.report(Diag::no_vrml97_value, scene_.where(s.texture), "Texture2", "model");
  n = scene_.add(nodes::Appearance, material ? scene_.where(material) : Span{});
  if (material) scene_.set(n, nodes::appearance::material, material);
  if (texture && !product) scene_.set(n, nodes::appearance::texture, texture);
  if (const NodeId t = texture_transform(map)) scene_.set(n, nodes::appearance::textureTransform, t);
  if (style) set_strokes(scene_, n, style);
  return n;
}

// ---- textures ------------------------------------------------------------------------------------------------------

bool Looks::has_texture(NodeId n) const {
  if (!n) return false;
  auto image = scene_.get(n, v1::texture2::image);
  return !scene_.get(n, v1::texture2::filename).empty() || (image.size() > 3 && image[0] > 0 && image[1] > 0);
}

NodeId Looks::texture_node(NodeId source) {
  if (!has_texture(source)) return {};
  auto& n = textures_[source];
  if (n) return n;
  auto file = scene_.get(source, v1::texture2::filename);
  const bool url = !file.empty();
  n = scene_.add(url ? nodes::ImageTexture : nodes::PixelTexture, scene_.where(source));
  scene_.set_name(n, scene_.name(source));
  if (url)
    scene_.set(n, nodes::image_texture::url, std::vector<std::string_view>{file});
  else
    scene_.set(n, nodes::pixel_texture::image, scene_.get(source, v1::texture2::image));
  const bool repeat_s = scene_.get(source, v1::texture2::wrapS) != "CLAMP",
             repeat_t = scene_.get(source, v1::texture2::wrapT) != "CLAMP";
  scene_.set(n, url ? nodes::image_texture::repeatS : nodes::pixel_texture::repeatS, repeat_s);
  scene_.set(n, url ? nodes::image_texture::repeatT : nodes::pixel_texture::repeatT, repeat_t);
  return n;
}

// T C R S -C, to what was in force before.
std::uint32_t Looks::then(std::uint32_t map, NodeId n) {
  namespace f = v1::texture2transform;
  const auto t = scene_.get(n, f::translation), c = scene_.get(n, f::center), k = scene_.get(n, f::scaleFactor);
  const double cosine = std::cos(scene_.get(n, f::rotation)), sine = std::sin(scene_.get(n, f::rotation));
  TexcoordMap own{cosine * k[0], -sine * k[1], sine * k[0], cosine * k[1], 0, 0};
  const auto moved = own(-c[0], -c[1]);
  own.x = moved[0] + c[0] + t[0];
  own.y = moved[1] + c[1] + t[1];
  const TexcoordMap all = maps_[map] * own;
  auto [i, fresh] = map_numbers_.emplace(all, static_cast<std::uint32_t>(maps_.size()));
  if (fresh) maps_.push_back(all);
  return i->second;
}

bool Looks::can_say(std::uint32_t map) const { return texture_transform_of(maps_[map]).has_value(); }

NodeId Looks::texture_transform(std::uint32_t map) {
  if (maps_[map] == TexcoordMap{}) return {};
  auto& n = transforms_[map];
  if (n) return n;
  const auto fields = texture_transform_of(maps_[map]);
  if (!fields) {
    diag_.report(Diag::no_vrml97_value, {}, "Texture2Transform", "scaleFactor");
    return NodeId{};
  }
  n = scene_.add(nodes::TextureTransform);
  scene_.set(n, nodes::texture_transform::rotation, fields->rotation, nodes::texture_transform::scale, fields->scale,
             nodes::texture_transform::translation, fields->translation);
  return n;
}

}  // namespace wrlkit::vrml1
