// What is not visible because a Switch is off.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Reports (hidden-geometry) when a tenth or more of the triangles are below Switches that show none of their children,
/// with the names of those that hide most. Counted are the roots of the file as it is: prototypes and Inlines are not
/// followed, and curved shapes count as about what they become. O(nodes), and O(indices) where a Switch is off.
void report_hidden_geometry(const Scene& scene, Diagnostics& diag);

}  // namespace wrlkit
