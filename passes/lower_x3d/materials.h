// Materials and viewpoints that VRML97 does not have.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns PhysicalMaterial and UnlitMaterial into Material, by the formulas of lower_x3d.h, and OrthoViewpoint into
/// Viewpoint, and reports it. For others than VRML97 an UnlitMaterial with a picture stays. False: there are none.
bool lower_materials(Scene&, bool vrml97, Diagnostics&);

}  // namespace wrlkit::x3d
