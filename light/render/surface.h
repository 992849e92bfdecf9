// An Appearance, ready to be asked for colours: its Material, its texture and the rules how they mix (ISO/IEC 14772-1,
// tables 4.5 and 4.6).
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "light/render/hatch.h"
#include "light/render/light.h"
#include "light/render/texture.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/looks/texture_transform_node.h"
#include "scenegraph/resources.h"

namespace wrlkit::drawing {

/// A picture that is laid over a surface.
struct Layer {
  std::shared_ptr<const Texture> texture;  // null: none
  TextureSampler sampler{};

  Texel sample(const std::array<double, 2>& at, double detail) const {
    return texture->sample(at[0], at[1], detail, sampler);
  }
};

/// Light that was computed before (docs/lighting.md), by place in a lightmap.
struct BakedLight {
  Layer light;                     // texel: irradiance / pi on the face, display-referred; null: none
  std::array<Layer, 3> direction;  // its mean direction, X, Y and Z; all or none
  TexcoordMap places;
  double scale = 1;

  explicit operator bool() const { return light.texture != nullptr; }
  /// What a white surface reflects there, linear.
  V3 at(const std::array<double, 2>& place, double detail) const;
};

struct Surface {
  bool lit = false;        // it has a Material or PhysicalMaterial
  bool shines = false;     // it has an UnlitMaterial: its colour is light of its own
  bool modulates = false;  // the picture multiplies the colour and does not replace it (picture_color.h)
  Lit material;
  V3 emissive;
  double alpha = 1;  // 1 - transparency
  Layer picture;
  // Further pictures of a material of X3D 4.0 (ISO/IEC 19775-1:2023, 12.4), at the places of `picture`.
  Layer glow, shadow, bumps;  // emission, occlusion of ambient light, normals
  double bump_scale = 1, shadow_strength = 1;
  std::optional<double> cutoff;  // alphaMode MASK: what is less is not there
  bool opaque = false;           // alphaMode OPAQUE
  std::optional<Hatch> hatch;
  TexcoordMap texcoords;
  BakedLight baked;

  /// The colour before lighting (ODrgb where there is light, ICrgb where not) and the alpha there. `vertex` is the
  /// colour that the geometry gives, RGB or RGBA; none: the Material's.
  Texel base(const std::optional<Texel>& vertex, const std::optional<Texel>& texel) const;
  /// A texel on top of a colour.
  void add(Texel& out, const Texel& texel) const;
  bool has_further_pictures() const { return glow.texture || shadow.texture || bumps.texture; }
};

/// The surfaces of a scene, each made once.
class Surfaces {
 public:
  Surfaces(const Scene& scene, Resources* resources, Diagnostics& diag);

  /// Index of the surface of an Appearance; of no Appearance, too.
  std::uint32_t of(NodeId appearance);
  const Surface& operator[](std::uint32_t i) const { return surfaces_[i]; }

 private:
  Surface make(NodeId appearance);
  Layer layer(NodeId texture, Texture::Means means = Texture::Means::light);
  Layer make_layer(NodeId texture, Texture::Means means);
  BakedLight baked_light(NodeId appearance);
  void further_pictures(Surface&, const MaterialNode&);
  void read_alpha_mode(Surface&, NodeId appearance) const;
  std::shared_ptr<const Texture> picture(const std::shared_ptr<const Image>& image, Texture::Means means);

  const Scene& scene_;
  Resources* resources_;
  Diagnostics& diag_;
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> index_;                                  // by NodeId; 0: not made yet
  std::map<std::pair<std::uint32_t, Texture::Means>, Layer> layers_;  // by NodeId
  std::map<std::pair<std::shared_ptr<const Image>, Texture::Means>, std::shared_ptr<const Texture>> textures_;
};

}  // namespace wrlkit::drawing
