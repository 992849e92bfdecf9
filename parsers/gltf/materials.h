// Materials of glTF as Appearance nodes: the inverse of what the glTF writer does (writers/gltf/materials.h).
//
// Colour. baseColorFactor is diffuseColor, or emissiveColor where KHR_materials_unlit says so; a picture of three or
// four channels replaces it (ISO/IEC 14772-1, table 4.6). roughness r is a highlight of shininess (2 / r^4 - 2) / 128
// and specularColor 0.01 / r^4, both up to 1; as rough as can be is black. Of metal, the highlight has the base colour.
// What wrlkit wrote has the very fields in extras.
//
// Baked light, of MOZ_lightmap or extras.lightmap, is the lightmap of the Appearance (docs/lighting.md). So is the
// emissiveTexture of what is black else: colour and light in one, of a white surface.
#pragma once
#include <map>
#include <optional>
#include <tuple>

#include "base/image/image.h"
#include "parsers/gltf/extras.h"
#include "scenegraph/looks/texture_transform_node.h"

namespace wrlkit::gltf_reader {

/// What a geometry brings to its material.
struct SurfaceKind {
  bool faces = true;  // not lines or points
  bool color = false;
  bool given_texcoord = false;  // coordinates that stay; others are made from the bounding box
  bool light = false;           // places in the lightmap of its material
  auto operator<=>(const SurfaceKind&) const = default;
};

struct Look {
  NodeId appearance;  // or none
  bool double_sided = false;
  Vec3 color_factor{1, 1, 1};  // linear; of the geometry's colours
  std::uint32_t texcoord = 0;  // TEXCOORD_n that the picture uses
  bool textured = false;
  std::optional<TexcoordMap> bake;  // to be applied to the texture coordinates
};

class Materials {
 public:
  Materials(const Context& c, Extras& extras) : c_(c), extras_(extras) {}

  const Look& get(std::uint32_t material, SurfaceKind);
  /// The Material nodes that a material has become, and whether faces have them.
  std::vector<std::pair<NodeId, bool>> nodes_of(std::uint32_t material) const;
  /// Index n of the TEXCOORD_n of a material's picture; nothing when it has none.
  std::optional<std::uint32_t> texcoord_set(std::uint32_t material) const;
  /// The same of its lightmap.
  std::optional<std::uint32_t> light_set(std::uint32_t material) const;
  /// All colour of a material is in its lightmap; those of the geometry do not show.
  bool is_light(std::uint32_t material) const;

 private:
  Look make(std::uint32_t material, SurfaceKind);
  NodeId material_node(Json, SurfaceKind, Look&);
  void set_color(NodeId material, Json, SurfaceKind, Look&);
  NodeId physical_node(Json, Json kept, SurfaceKind, const Look&);
  void set_further_pictures(NodeId material, Json);
  static double transparency_of(Json, const Look&);
  void set_highlight(NodeId material, Json);
  NodeId texture(std::uint32_t index);
  NodeId make_texture(Json);
  NodeId pixel_texture(Json texture, Json image);
  void set_sampler(NodeId texture, Json sampler);
  std::uint32_t image_of(Json texture) const;
  std::optional<Image> decoded(Json image);
  NodeId light_of_linear(std::uint32_t texture);
  std::vector<std::string> urls(Json texture, std::uint32_t image);
  std::string picture_url(std::uint32_t index, Json image);
  NodeId texture_transform(Json info, SurfaceKind, Look&);
  NodeId transform_node(const TexcoordMap&, Json said);
  void set_light(NodeId appearance, Json material);
  void report_lost(Json);
  bool is_multiplied(Json, SurfaceKind, NodeId material) const;
  NodeId same_named(NodeId, TypeId);

  Context c_;
  Extras& extras_;
  std::map<std::tuple<std::uint32_t, SurfaceKind>, Look> looks_;
  std::map<std::uint32_t, NodeId> textures_, linear_lights_;
  std::map<std::uint32_t, std::string> image_urls_;
  std::map<std::pair<std::uint32_t, std::string>, NodeId> named_;
  std::set<std::uint32_t> reported_;
};

}  // namespace wrlkit::gltf_reader
