// How large the surfaces of a scene are shown.
#pragma once
#include <span>
#include <vector>

#include "geometry/simplify/surfaces.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Of each surface the largest over its places: metres of the world for a unit of the geometry. 1 where it stands
/// nowhere, or is scaled to nothing.
std::vector<double> largest_scales(const Scene& scene, std::span<const ShapeSurface> surfaces);
/// The same where `expanded` shows them: the scene with instances of prototypes replaced by their bodies, where nodes
/// of both have the same numbers. What that shows nowhere has its scale in `scene`.
std::vector<double> largest_scales(const Scene& scene, const Scene& expanded, std::span<const ShapeSurface> surfaces);

/// By Shape: the number of its surface among these, from 1; 0: of none.
std::vector<std::uint32_t> surface_numbers(const Scene& scene, std::span<const ShapeSurface> surfaces);

}  // namespace wrlkit
