// LOD nodes over whole groups: their further levels are the group with simpler surfaces.
#pragma once
#include <span>

#include "geometry/simplify/leveled_surface.h"
#include "geometry/simplify/lod_nodes.h"

namespace wrlkit {

/// Puts LODs around the innermost groups that hold several Shapes, and around other Shapes by themselves, with what is
/// there as the first level. Further levels are copies, without names, of what differs in them; the rest is shared with
/// the first, but for nodes that are bound (Viewpoint), which the first alone has. A node that a ROUTE reaches, and a
/// LOD, is not copied: what lies below it has LODs of its own. O(nodes * levels).
LodCounts add_group_lods(Scene& scene, std::span<const LeveledSurface> surfaces, const LodLimits& limits);

}  // namespace wrlkit
