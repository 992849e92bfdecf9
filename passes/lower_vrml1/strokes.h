// How wide lines and points of a DrawStyle are, and of what strokes: as X3D says it.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::vrml1 {

/// Whether a DrawStyle says more of them than which there are.
bool says_strokes(const Scene&, NodeId draw_style);
/// Gives an Appearance the LineProperties and PointProperties of a DrawStyle.
void set_strokes(Scene&, NodeId appearance, NodeId draw_style);

}  // namespace wrlkit::vrml1
