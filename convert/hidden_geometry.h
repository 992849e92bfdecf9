// What is not visible because a Switch is off.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Reports (hidden-geometry) when a tenth or more of the triangles are below Switches that show none of their children,
/// with the names of those that hide most. Prototypes are followed, and Inlines, which `files` reads (expanded_copy.h);
/// null: Inlines are not. Curved shapes count as about what they become. O(nodes), and O(indices) where there is a
/// Switch.
void report_hidden_geometry(const Scene& scene, Resources* files, Diagnostics& diag);

}  // namespace wrlkit
