// A scene that is far away is moved to the origin (origin.h), because viewers work in single precision.
#pragma once
#include "writers/gltf/document/document.h"

namespace wrlkit::gltf {

/// Subtracts world_origin from the outermost translations, if there is one: nodes that have none of their own pass it
/// on to their children, so that no node stays far away. Sets Document::origin.
void move_to_origin(Document&);

}  // namespace wrlkit::gltf
