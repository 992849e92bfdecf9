// How the picture of an Appearance and the colour below it mix.
#pragma once
#include "scenegraph/looks/material_node.h"
#include "scenegraph/nodes.h"

namespace wrlkit {

/// Whether a picture in colour is multiplied by the colour of the material or of the vertices: a picture of a
/// material's own, of the materials that came with X3D 4.0, and in scenes of that version (ISO/IEC 19775-1:2023, 12.4).
/// Elsewhere it takes the place of the colour (14772-1, table 4.6). VRML 1.0 multiplies, too: its pictures become those
/// of materials. The opacity of a picture is multiplied, or takes the place of that of the material, by the same rule.
inline bool multiplies_picture(const Scene& scene, NodeId appearance) {
  const auto material = material_of(scene, appearance);
  if (material && (material->kind != MaterialNode::Kind::phong || material->color_picture)) return true;
  return scene.dialect() == Dialect::x3d && scene.x3d.version >= 40;
}

}  // namespace wrlkit
