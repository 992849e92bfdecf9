// Lights that events change, of which a lightmap can hold one state only.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// Reports each field that a ROUTE sets of a light or of a group around one or around something that shines, such as a
/// Transform that carries it or a Switch that turns it off. O(n log n) in the nodes of a scene with ROUTEs.
void report_driven_lights(const Scene&, Diagnostics&);

}  // namespace wrlkit::bake
