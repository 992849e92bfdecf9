// A scene that is far away is moved to the origin (origin.h), because viewers work in single precision; or any scene,
// to an origin that it shares with others.
#pragma once
#include "writers/gltf/document/document.h"
#include "writers/gltf/origin_option.h"

namespace wrlkit::gltf {

/// Subtracts the origin from the outermost translations: nodes that have none of their own pass it on to their
/// children, so that no node stays far away. Sets Document::origin; none: nothing was moved.
void move_to_origin(Document&, const GltfOrigin& = {});

}  // namespace wrlkit::gltf
