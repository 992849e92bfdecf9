// Nodes that only browsers have, as those of the standard that mean the same.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// A MatrixTransform (Castle Game Engine, InstantReality, X3DOM) becomes a Transform, the CommonSurfaceShader
/// (InstantReality, X3DOM, Castle Game Engine) of an Appearance its Material, with the pictures. False: the node is
/// another one.
bool lower_browser_node(Scene&, NodeId);

}  // namespace wrlkit::x3d
