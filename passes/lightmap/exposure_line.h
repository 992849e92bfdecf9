// How much brighter baked light is shown than it is, as a line of the world's WorldInfo: so that it can be undone.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// "lightmap exposure 3.4" becomes a line of the first WorldInfo, instead of one that a bake before has left; a world
/// without a WorldInfo gets one.
void keep_exposure(Scene& scene, double factor);

}  // namespace wrlkit::bake
