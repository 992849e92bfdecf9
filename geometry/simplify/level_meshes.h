// The mesh of a surface where each of its parts is on a rung of its ladder.
#pragma once
#include <functional>
#include <span>
#include <vector>

#include "geometry/simplify/world_parts.h"

namespace wrlkit::simplify {

/// The rung of each part of a world, or Allocation::gone.
using Rungs = std::vector<std::uint32_t>;

/// The surface at several points: parts are joined, and have the attributes of the surface. All points are made
/// together, because what a part needs for that, a tree of its triangles above all, serves all of them. A mesh is
/// without corners where all parts are gone.
std::vector<Mesh> level_meshes(const WorldParts& world, const PlacedSurface& s,
                               std::span<const std::reference_wrapper<const Rungs>> points);

}  // namespace wrlkit::simplify
