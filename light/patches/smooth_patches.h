// Patches with three colours, so that their edges are not seen (Lazanyi, 3.2): the colour of a vertex is that of the
// patches that meet there, weighted by their angles.
#pragma once
#include <array>
#include <span>
#include <vector>

#include "light/render/linear.h"

namespace wrlkit::light {

using drawing::V3;

struct MeetingPatch {
  std::array<V3, 3> corners, normals;  // normals for shading, at the corners, of the side that is lit
  V3 color;
};

/// Colours of the corners of each patch. Corners are one vertex when they lie in one place, up to a thousandth of the
/// mean patch, and the surface is smooth there: their normals differ by no more than 14 degrees. O(patches).
std::vector<std::array<V3, 3>> smooth_colors(std::span<const MeetingPatch> patches);

}  // namespace wrlkit::light
