// Materials and textures of X3D that are replaced by others.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Leaves of a TwoSidedMaterial the front and of a MultiTexture, with its coordinates and transforms, the first, and
/// takes the picture of a material for that of an Appearance that has none. False: nothing to do.
bool lower_appearance(Scene&, NodeId, Diagnostics&);

}  // namespace wrlkit::x3d
