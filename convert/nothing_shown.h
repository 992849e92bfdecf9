// Scenes of which a browser would draw nothing: prototypes that nobody uses, Switches that are off, lights alone.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Reports that nothing of a scene is drawn, and why, as far as the scene itself tells: Inlines are not followed, and
/// count as drawn. O(1) for most scenes, whose first Shapes answer it; with prototypes in place of Shapes O(nodes).
void report_nothing_shown(const Scene&, Diagnostics&);

/// What a browser would not draw of a scene as it was read: this, and hidden_geometry.h.
void report_undrawn(const Scene&, Diagnostics&);

}  // namespace wrlkit
