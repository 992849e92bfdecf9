// Appearance to glTF material, by the lighting model of ISO/IEC 14772-1, 4.14. Equal appearances become one material.
//
// Colour. With a Material a face is lit: its diffuse colour is that of the Material, or the Color of the geometry in
// its place; a picture of one or two channels is multiplied by it, one of three or four replaces it (table 4.6).
// Without a Material it is unlit, white or of its Color (table 4.5). A picture with alpha replaces transparency. Lines
// and points are unlit, of emissiveColor or Color, and have no picture.
//
// Highlights. metallicFactor is 0. The exponent of Blinn's highlight, n = 128 shininess, is that of a microfacet
// surface of alpha^2 = 2 / (n + 2), and glTF's roughness is the root of alpha. How bright a highlight is, core glTF
// cannot say: a surface reflects 4 %, so that the middle of the highlight shines with 0.01 / alpha^2. Where that is
// more than s, the largest component of specularColor, a wider one makes up for it: roughness = max(2 / (n + 2), 0.01 /
// s) ^ (1/4), but no more than 1. So black is as rough as can be. Where it is less, the highlight is too dim.
// specularColor, shininess and ambientIntensity stay in extras.
//
// Baked light. Where the geometry has places in a lightmap they are the set of texture coordinates behind that of the
// picture: 1, or 0 when there is none. See GltfOptions::Lightmaps. The texture coordinates of MOZ_lightmap and extras
// are written as in any textureInfo, with KHR_texture_transform for lightmapTransform; a texel is what a white surface
// reflects.
//
// X3D 4.0 (ISO/IEC 19775-1, 12 and 17.2). A PhysicalMaterial is glTF's own; an UnlitMaterial is unlit and of its
// emissiveColor. There, and with every material of a file of version 4.0, a picture is multiplied by the colour and
// never replaces it. Pictures for normals, occlusion, emission, metal and roughness are those of glTF; that they may
// have texture coordinates of their own, by name, is kept in extras. alphaMode and alphaCutoff are glTF's as well.
#pragma once
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "writers/gltf/color.h"
#include "writers/gltf/extras.h"
#include "writers/gltf/gltf.h"
#include "writers/gltf/motion.h"
#include "writers/gltf/texture_transform.h"
#include "writers/gltf/textures.h"

namespace wrlkit::gltf {

double roughness(double shininess, const Vec3& specular);

/// What a geometry brings to its material.
struct SurfaceKind {
  bool faces = true;  // not lines or points
  bool color = false, texcoord = false;
  bool light = false;  // places in a lightmap
  bool double_sided = false;
  bool opacity = false;  // of its colours
};

struct MaterialUse {
  std::uint32_t material = none;
  NodeId bake;  // a TextureTransform that must be applied to the texture coordinates
  bool shows_light = false;
  NodeId bake_light;        // as bake, for the places in the lightmap
  bool shows_color = true;  // false: a picture takes the place of the geometry's colours
};

class Materials {
 public:
  Materials(const Scene& scene, Textures& textures, const Motion& motion, Extras* extras,
            GltfOptions::Lightmaps lightmaps)
      : scene_(scene), textures_(textures), motion_(motion), extras_(extras), lightmaps_(lightmaps) {}

  /// Has an Appearance a picture that can be shown?
  bool has_picture(NodeId appearance);
  /// The material of an Appearance, or of none.
  MaterialUse get(NodeId appearance, SurfaceKind);

  /// What fields of a node that are moved do to one of its materials.
  struct Moved {
    std::uint32_t material;
    NodeId source;
    Vec3 base, emissive;
    double alpha;
    std::string_view base_field;  // empty: nothing of the source is in the base colour
    bool shows_alpha, shows_emissive, lit;
    NodeId transform;                      // a TextureTransform that is moved; none: it stands still
    std::vector<std::string_view> mapped;  // pictures that it moves, by their path in the material
  };
  const std::vector<Moved>& moved() const { return moved_; }
  /// Fields of materials that are moved, but not shown: a lightmap stands in place of the colours.
  const std::set<Motion::Field>& outshone() const { return outshone_; }

  /// The JSON of each material.
  const std::vector<std::string>& materials() const { return materials_; }
  bool uses_unlit() const { return unlit_; }
  bool uses_moz_lightmap() const { return moz_lightmap_; }
  bool uses_texture_transform() const { return texture_transform_; }

 private:
  struct Look;
  bool find_picture(NodeId appearance);
  MaterialUse make(NodeId appearance, SurfaceKind);
  bool moves(const Look&, std::string_view field) const;
  bool moves(const Look&) const;
  bool moves_picture(const Look&) const;
  static std::vector<std::string_view> mapped(const Look&);
  Look look(NodeId appearance, SurfaceKind);
  void look_at_light(Look&);
  void outshine(const Look&, std::string_view field);
  bool replaced_by_light(const Look&) const;
  std::string json(const Look&);
  void read_material(Look&);
  void read_alpha_mode(Look&);
  void further_pictures(Look&);
  void pbr(JsonOut&, const Look&);
  void texture_info(JsonOut&, const Look&, std::string_view name, std::uint32_t texture, const char* factor = nullptr,
                    double value = 1);
  void texture_info_members(JsonOut&, std::uint32_t texture, std::uint32_t set, const TexcoordMap&, bool moved = false);
  void light_info(JsonOut&, const Look&);
  void extensions(JsonOut&, const Look&);
  void light_extras(JsonOut&, const Look&);
  std::vector<std::uint16_t> said_by_x3d(const Look&) const;
  static std::vector<std::uint16_t> said_by_appearance(const Look&);
  std::vector<std::uint16_t> said_by_vrml97(const Look&) const;
  void extras(JsonOut&, const Look&);

  const Scene& scene_;
  Textures& textures_;
  const Motion& motion_;
  Extras* extras_;
  GltfOptions::Lightmaps lightmaps_;
  std::unordered_map<std::uint64_t, MaterialUse> uses_;
  std::unordered_map<std::uint32_t, bool> pictured_;  // of Appearances
  std::unordered_map<std::string, std::uint32_t> by_json_;
  std::vector<std::string> materials_;
  std::vector<Moved> moved_;
  std::set<Motion::Field> outshone_;
  bool unlit_ = false, texture_transform_ = false, moz_lightmap_ = false;
};

}  // namespace wrlkit::gltf
