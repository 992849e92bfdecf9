// What is said of a node and changes nothing that is shown: metadata of X3D, and fields that its type does not have.
// Exporters keep tags, names of materials and the like there.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit {

/// The names of parts that a pass has merged (features.h) are none.
bool is_tag(const Scene&, NodeId, const Value&);
bool has_tags(const Scene&, NodeId);

}  // namespace wrlkit
