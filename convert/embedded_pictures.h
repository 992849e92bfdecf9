// Pictures embedded in a glTF file, as separate files.
#pragma once
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// ImageTextures whose url is the picture itself get one of a made file instead, which writers put next to what they
/// write: out.wrl has out.picture_0.png. Each picture is there once.
void unpack_pictures(Scene&, Resources&);

}  // namespace wrlkit
