// Scenes of which a browser would draw nothing: prototypes that nobody uses, Switches that are off, lights alone.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Reports what a browser would not draw of a scene as it was read: what Switches hide, in the files that Inlines name
/// too where `files` is not null (hidden_geometry.h), or that nothing at all is drawn, and why, as far as the scene
/// itself tells: for that, Inlines count as drawn. The latter is O(1) for most scenes, whose first Shapes answer it;
/// with prototypes in place of Shapes O(nodes).
void report_undrawn(const Scene&, Resources* files, Diagnostics&);

}  // namespace wrlkit
