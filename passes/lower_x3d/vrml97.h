// The rest of the way from X3D to VRML97.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns or drops everything that VRML97 lacks, and reports it. Afterwards the scene is one of VRML97: its format
/// says so, ROUTEs have the names of VRML97, meta statements are comments. False: there was nothing to do.
bool lower_to_vrml97(Scene&, Diagnostics&);

}  // namespace wrlkit::x3d
