// How the picture of an Appearance and the colour below it mix.
#pragma once
#include "scenegraph/nodes.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// The picture of the base colour that a material of X3D 4.0 has itself; none: it has none, or is of another kind.
inline NodeId own_picture(const Scene& scene, NodeId material) {
  if (scene.is(material, nodes::Material)) return scene.get(material, nodes::material::diffuseTexture);
  if (scene.is(material, nodes::PhysicalMaterial)) return scene.get(material, nodes::physical_material::baseTexture);
  if (scene.is(material, nodes::UnlitMaterial)) return scene.get(material, nodes::unlit_material::emissiveTexture);
  return {};
}

/// Whether a picture in colour is multiplied by the colour of the material or of the vertices: a picture of a
/// material's own, of the materials that came with X3D 4.0, and in worlds of that version (ISO/IEC 19775-1:2023, 12.4).
/// Elsewhere it takes the place of the colour (14772-1, table 4.6). VRML 1.0 multiplies, too: its pictures become those
/// of materials.
inline bool multiplies_picture(const Scene& scene, NodeId appearance) {
  const NodeId m = scene.get(appearance, nodes::appearance::material);
  if (scene.is(m, nodes::PhysicalMaterial) || scene.is(m, nodes::UnlitMaterial)) return true;
  return own_picture(scene, m) || (scene.dialect() == Dialect::x3d && scene.x3d.version >= 40);
}

}  // namespace wrlkit
