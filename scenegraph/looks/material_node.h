// The values of a material node, whichever of the three it is (ISO/IEC 14772-1, 6.27; 19775-1:2023, 12.4).
#pragma once
#include <optional>

#include "scenegraph/scene.h"

namespace wrlkit {

/// What its type does not have keeps its value here. Numbers are as in the file, not clamped.
struct MaterialNode {
  enum class Kind : std::uint8_t { phong, physical, unlit };  // Material, PhysicalMaterial, UnlitMaterial

  Kind kind = Kind::phong;
  // Colours are as displayed; a PhysicalMaterial has linear ones, as in glTF (2.0, 3.9.2) and X_ITE 15.
  Vec3 color{0.8, 0.8, 0.8};  // of faces: diffuseColor, baseColor, of an UnlitMaterial its emissiveColor
  Vec3 emissive{0, 0, 0};
  Vec3 specular{0, 0, 0};
  double ambient_intensity = 0.2, shininess = 0.2;
  double metallic = 0, roughness = 1;
  double transparency = 0;
  double normal_scale = 1, occlusion_strength = 1;
  // Pictures; none: no node. That of an UnlitMaterial's colour is color_picture alone.
  NodeId color_picture, emissive_picture, normal_picture, occlusion_picture, metallic_roughness_picture;
  std::uint16_t color_picture_slot = 0;
};

/// Nothing for no node and for nodes of other types.
std::optional<MaterialNode> read_material(const Scene&, NodeId material);
/// The material of an Appearance, or none.
std::optional<MaterialNode> material_of(const Scene&, NodeId appearance);

}  // namespace wrlkit
