// LOD nodes that show their first level from anywhere.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// Removes the other levels of each LOD, and its ranges, where nothing but forms is lost: not where they hold anything
/// else (Viewpoints, sensors, sounds, ends of ROUTEs), where events change the LOD, where it only hides (the others are
/// empty), or where its first level is empty. The number of those that were cut. O(nodes in LODs).
std::size_t keep_first_levels(Scene& scene);

}  // namespace wrlkit
