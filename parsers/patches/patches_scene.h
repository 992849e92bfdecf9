// A patch file as a scene of its own, so that it can be looked at like any other: `wrlkit render patches.xml
// picture.png`.
#pragma once
#include "scenegraph/patches.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Adds an unlit Shape for each shape of the set, with the colour of each patch on its face; brighter than white is
/// white. What lies on back sides is seen from there.
void add_patches(const PatchSet& set, Scene& scene);

}  // namespace wrlkit
