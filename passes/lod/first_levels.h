// LOD nodes that show their first level from anywhere.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// Removes the other levels of each LOD, and its ranges; not of those whose other levels hold more than what is drawn
/// from afar: ends of ROUTEs, Scripts, Viewpoints and other bound nodes, lights. How many had others. O(nodes in LODs).
std::size_t keep_first_levels(Scene& scene);

}  // namespace wrlkit
