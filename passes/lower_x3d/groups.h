// Groups of X3D as those of VRML97.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns a node that only X3D has and that shows what it holds (a layer, a joint, a body) into a Group or Transform,
/// which is called as it called itself, and hides what is not visible. False: nothing to do.
bool lower_group(Scene&, NodeId, Diagnostics&);

}  // namespace wrlkit::x3d
