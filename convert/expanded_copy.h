// A scene as it is once its Inlines and prototypes are followed, for those who look into it before a pass does.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// A copy in VRML97, without prototypes and Inlines. `files`: what Inlines name is read through it, and what is wrong
/// there is reported now, as it would be by a pass; null: they stay Inlines. Nothing else is reported. O(nodes); the
/// arrays are shared.
Scene expanded_copy(const Scene&, Resources* files, Diagnostics&);

}  // namespace wrlkit
