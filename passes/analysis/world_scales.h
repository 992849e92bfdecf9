// How large the surfaces of a scene are shown, where instances of prototypes show them too.
#pragma once
#include <span>
#include <vector>

#include "geometry/simplify/surfaces.h"
#include "scenegraph/resources.h"

namespace wrlkit {

/// As largest_scales (geometry/simplify/surface_scales.h), with what an instance says of the body's Transforms. Nothing
/// is reported. `files` may be null: EXTERNPROTOs show nothing then. Copies a scene that has prototypes; otherwise
/// O(nodes + places).
std::vector<double> world_scales(const Scene& scene, std::span<const ShapeSurface> surfaces, Resources* files);

}  // namespace wrlkit
