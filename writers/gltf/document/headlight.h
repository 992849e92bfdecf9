// Viewers light what has no lights; where a scene has lights of its own they do not, and the headlight would be missed.
// It goes with the first camera, where a browser would be in the beginning, or looks along -Z without one; there is
// only one, because all lights of glTF shine at the same time.
#pragma once
#include "writers/gltf/document/document.h"

namespace wrlkit::gltf {

/// Nothing without lights, or when the NavigationInfo says that there is none.
void add_headlight(Document&, const Scene&);

}  // namespace wrlkit::gltf
