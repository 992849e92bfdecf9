// Curves and surfaces of the component NURBS (ISO/IEC 19775-1, 27) as faces and lines.
#pragma once
#include <span>

#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns a NurbsPatchSurface, NurbsTrimmedSurface (whole: contours are not cut), or NurbsSwungSurface into an
/// IndexedFaceSet of triangles with exact normals, a NurbsCurve into an IndexedLineSet, a NurbsSweptSurface into an
/// Extrusion, and a CoordinateDouble into a Coordinate. `tolerance`: how far lines and triangles may be from what is
/// meant, in metres; 0: a thousandth of the diagonal of the control points. What cannot be is reported and empty.
/// False: it is another node.
bool lower_nurbs(Scene&, NodeId, double tolerance, Diagnostics&);

/// NurbsPositionInterpolator and NurbsOrientationInterpolator as interpolators with as many keys as the tolerance asks
/// for.
bool lower_nurbs_interpolator(Scene&, NodeId, double tolerance, Diagnostics&);

/// A NurbsSurfaceInterpolator as a PositionInterpolator, when a PositionInterpolator2D with that `key` and those
/// `places` (u, v from 0 to 1, two for each key) leads over it. False: it has no surface. O(keys), 64 for one at most.
bool lower_surface_interpolator(Scene&, NodeId, std::span<const double> key, std::span<const double> places,
                                double tolerance, Diagnostics&);

}  // namespace wrlkit::x3d
