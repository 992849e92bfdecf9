// A scene in metres, Y up.
#pragma once
#include "convert/options.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Puts a Transform above the roots that scales to metres and turns Y up; nothing where that changes nothing.
void place_world(Scene&, Unit, UpAxis);

}  // namespace wrlkit
