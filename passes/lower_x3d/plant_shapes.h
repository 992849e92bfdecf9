// X3DOM's shapes of plants (its component Geometry3DExt), Torus and Plane.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Gives Shapes with such a geometry the form that it is (scenegraph/nodes/wrlkit.nodes), or faces. A Shape whose form
/// stands elsewhere than its frame becomes a Transform around itself, and one of several forms a Group, unless a ROUTE
/// leads to it or from it; then it stays as it is. True when there was one. O(scene).
bool lower_plant_shapes(Scene&, Diagnostics&);

}  // namespace wrlkit::x3d
