// LOD nodes that show their first level from anywhere.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// Removes the other levels of each LOD, and its ranges. The number of those that had others. O(nodes).
std::size_t keep_first_levels(Scene& scene);

}  // namespace wrlkit
