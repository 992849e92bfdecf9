// Geometry that may be replaced by other geometry somewhere else, because each of its Shapes stands where a Transform
// can stand, too.
#pragma once
#include <functional>
#include <vector>

#include "geometry/simplify/surfaces.h"
#include "passes/analysis/usage.h"

namespace wrlkit {

/// Geometry of the main scope, in the order of the file: all Shapes that hold it are plain, are held by lists of
/// children only, and pass, as the geometry does. O(nodes).
std::vector<ShapeSurface> placed_surfaces(const Scene& scene, const Usage& usage,
                                          const std::function<bool(NodeId shape, NodeId geometry)>& may_change);

}  // namespace wrlkit
