// Interpolators that go along smooth curves, as those of VRML97 with more keys.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

/// SplinePositionInterpolator, SplineScalarInterpolator and SquadOrientationInterpolator become PositionInterpolator,
/// ScalarInterpolator and OrientationInterpolator (ISO/IEC 19775-1, 19.2.3 and 19.4), EaseInEaseOut a
/// ScalarInterpolator, with enough keys that values are within a thousandth of the range of their key values, or of a
/// turn; at most 64 for one. ROUTEs from modifiedFraction_changed come from value_changed. With `report` each is
/// reported as no curve of VRML97. False: there are none. O(keys).
bool lower_interpolators(Scene&, bool report, Diagnostics&);

}  // namespace wrlkit::x3d
