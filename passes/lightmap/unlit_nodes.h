// What the pass does not look into: scenes behind Inline, what instances of prototypes show, and nodes that VRML97 does
// not have.
#pragma once
#include <cstddef>

#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// Inlines, and instances of prototypes with surfaces or with what makes them (of an EXTERNPROTO nobody knows, so it
/// counts), among all nodes of the main scope. Linear.
std::size_t closed_nodes(const Scene& scene);

/// Surfaces that are nodes of VRML 1.0, or of X3D alone, in the main scope: nobody has lowered them. Linear.
std::size_t foreign_surfaces(const Scene& scene);

}  // namespace wrlkit::bake
