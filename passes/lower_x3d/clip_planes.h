// ClipPlanes: what they hide is cut off.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit::x3d {

/// Cuts the Shapes next to each ClipPlane, and those below its siblings, in place where they are drawn once and as
/// copies where they are drawn elsewhere, too. ClipPlanes that no ROUTE moves leave the scene, the others stay without
/// effect. Prototypes and Inlines that have not been expanded stay whole, and so does geometry whose points events
/// move. O(scene), and the triangles of what is cut for each different set of planes.
bool cut_by_clip_planes(Scene&, PassContext&);

}  // namespace wrlkit::x3d
