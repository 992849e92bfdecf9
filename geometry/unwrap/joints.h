// Where something developable ends and something curved begins, though the two meet smoothly: pipe and elbow, tank and
// dome. Cut there, a pipe is unrolled to a rectangle, and the elbow's distortion stays in the elbow.
#pragma once
#include "geometry/unwrap/links.h"

namespace wrlkit::unwrap {

/// Cuts the links at joints. Almost linear.
void cut_joints(Links& links);

}  // namespace wrlkit::unwrap
