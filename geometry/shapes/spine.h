// The planes in which the cross-sections of an Extrusion stand (ISO/IEC 14772-1, 6.18.2 and 6.18.3).
#pragma once
#include <span>
#include <vector>

#include "scenegraph/value.h"

namespace wrlkit {

/// Axes of the spine-aligned cross-section plane: unit vectors, right-handed; y runs along the spine.
struct SpinePlane {
  Vec3 x, y, z;
};

/// One plane for each point of the spine.
///
/// - Points that coincide with the one before have its plane; a spine of one point, however often, has the axes
///   themselves.
/// - A spine that is straight as a whole turns Y into its direction on the shortest way; (0, -1, 0) by half a turn
///   about Z.
/// - Three points count as collinear when the sine at the middle one is less than the digits of the coordinates can
///   tell (1e-5, more where coordinates are large for their distance); then the Z axis of the point before is taken,
///   at the start that of the first point that has one.
/// - A spine that is closed has the same plane at both ends, even where that twists the last segment.
std::vector<SpinePlane> spine_planes(std::span<const Vec3> spine);

}  // namespace wrlkit
