// Materials and textures of X3D that stand for others.
#pragma once
#include "scenegraph/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// The picture of the main colour of a material of X3D 4.0; none where it has none.
NodeId picture_of(const Scene&, NodeId material);

/// Leaves of a TwoSidedMaterial the front and of a MultiTexture, with its coordinates and transforms, the first, and takes
/// the picture of a material for that of an Appearance that has none. False: nothing to do.
bool lower_appearance(Scene&, NodeId, Diagnostics&);

}  // namespace wrlkit::x3d
