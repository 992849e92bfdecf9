// TextureBackground as the Background that VRML97 has.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns a TextureBackground (ISO/IEC 19775-1, 24.4.6) into a Background with the urls of its ImageTextures; other
/// textures are reported as lost. False: it is another node.
bool lower_texture_background(Scene&, NodeId, Diagnostics&);

}  // namespace wrlkit::x3d
