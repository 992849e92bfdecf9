// Materials and viewpoints that VRML97 does not have.
#pragma once
#include "scenegraph/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns PhysicalMaterial and UnlitMaterial into Material, by the formulas of lower_x3d.h, and OrthoViewpoint into Viewpoint,
/// and reports it. False: there are none.
bool lower_materials(Scene&, Diagnostics&);

}  // namespace wrlkit::x3d
