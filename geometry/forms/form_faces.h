// Forms of our own as the faces that they represent: for writers of formats that have no such node.
#pragma once
#include <optional>

#include "scenegraph/scene.h"

namespace wrlkit {

/// A copy of the scene in which every form of our own is an IndexedFaceSet with the form's own segments; nothing when
/// there is none. Arrays are shared. O(nodes).
std::optional<Scene> with_form_faces(const Scene& scene);

}  // namespace wrlkit
