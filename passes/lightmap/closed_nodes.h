// What the pass does not look into: worlds behind Inline, and what prototypes stand for.
#pragma once
#include <cstddef>

#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// Inlines, and instances of prototypes with surfaces or with what makes them (of an EXTERNPROTO nobody knows, so it counts), among
/// all nodes of the main scope. Linear.
std::size_t closed_nodes(const Scene& scene);

}  // namespace wrlkit::bake
