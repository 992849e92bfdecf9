// How wide lines and points are drawn (ISO/IEC 19775-1:2023, 12.4.3 and 12.4.7).
#pragma once
#include <vector>

#include "light/render/mesh_pool.h"
#include "light/render/stage.h"

namespace wrlkit::drawing {

/// The LineProperties of an Appearance, where they apply; none: lines are plain.
NodeId line_properties(const Scene&, NodeId appearance);

/// By use: factors for the width of plain lines and points, by LineProperties and PointProperties (without
/// attenuation); empty where all are plain. O(uses).
std::vector<float> widths_of(const Scene&, const Stage&, const MeshPool&, std::span<const std::uint32_t> mesh_of);

}  // namespace wrlkit::drawing
