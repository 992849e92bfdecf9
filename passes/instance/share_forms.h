// Geometry that is a form: shared where only its size differs.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::instancing {

/// Puts unit forms in the place of Box, Cylinder and other forms, each Shape with a scale that makes it what it was
/// within `tolerance` metres of the world. Geometry of more than `most_places` Shapes stays; 0: any number. Returns how
/// many geometries are gone. n log n in the nodes.
std::size_t share_forms(Scene& scene, double tolerance, int most_places);

}  // namespace wrlkit::instancing
