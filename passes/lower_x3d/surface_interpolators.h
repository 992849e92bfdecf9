// Points that move over surfaces (ISO/IEC 19775-1, 27.4.10).
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// A NurbsSurfaceInterpolator that one PositionInterpolator2D drives by a ROUTE becomes a PositionInterpolator that is
/// driven by what drives that. One whose normals are asked for, or that is driven otherwise, stays as it is. False:
/// there are none. O(ROUTEs) for each, and once.
bool lower_surface_interpolators(Scene&, double tolerance, Diagnostics&);

}  // namespace wrlkit::x3d
