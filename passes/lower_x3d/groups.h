// Groups of X3D as those of VRML97.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns a grouping node that only X3D has into a Group or Transform, which is called as it called itself, and hides
/// what is not visible. False: nothing to do.
bool lower_group(Scene&, NodeId);

}  // namespace wrlkit::x3d
