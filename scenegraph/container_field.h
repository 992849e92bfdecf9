// In which field of the node around it a node of X3D stands when the file does not say (ISO/IEC 19776-1, 4.3.3).
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// For an instance of a prototype: that of the first node of its body. "children" where none is known.
std::string_view container_field(const Scene&, NodeId);

}  // namespace wrlkit
