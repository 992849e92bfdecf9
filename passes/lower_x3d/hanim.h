// Humanoids (ISO/IEC 19774, ISO/IEC 19775-1, 26), which the node table does not know, as the groups that they are.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// HAnimHumanoid, HAnimJoint and HAnimSite become Transforms, HAnimSegment a Group: as they stand, moved by no joint.
/// What a humanoid lists beside its skeleton (joints, segments, sites) are the same nodes once more and show nothing;
/// its skin does. False: it is none of them.
bool lower_humanoid(Scene&, NodeId, Diagnostics&);

}  // namespace wrlkit::x3d
