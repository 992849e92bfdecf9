// What KHR_animation_pointer moves: base colour with opacity, emission, metal and roughness of materials, colour and
// intensity of lights, the angle of cameras, as the fields of VRML that they were made of.
#pragma once
#include "writers/gltf/animations.h"
#include "writers/gltf/document/document.h"
#include "writers/gltf/materials.h"

namespace wrlkit::gltf {

void add_pointers(Animations&, const Scene&, const Materials&, const Document&, Diagnostics&);

}  // namespace wrlkit::gltf
