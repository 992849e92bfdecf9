// Which version of X3D a scene needs.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// The oldest from 3.3 on that can describe the scene as it looks, 33 for 3.3: 4.0 where a node or field of its own is
/// there (the node table knows), and for a scene that was 4.0 already, which multiplies a picture in colour by the
/// colour where older ones replace it. O(fields).
int x3d_version(const Scene&);

}  // namespace wrlkit
