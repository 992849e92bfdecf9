// A scene that is far away is moved to the origin (origin.h), because viewers work in single precision; or any scene,
// to an origin that it shares with others.
#pragma once
#include <functional>

#include "writers/gltf/document/document.h"
#include "writers/gltf/origin_option.h"

namespace wrlkit::gltf {

using IsAnimated = std::function<bool(NodeId)>;

/// Subtracts the origin from the outermost translations. Nodes that have none of their own pass it on to their
/// children, and so do those whose children are still far away from them, unless they are animated or shared: no node
/// stays far away. Sets Document::origin; none: nothing was moved. O(nodes).
void move_to_origin(Document&, const GltfOrigin& = {}, const IsAnimated& = {});

}  // namespace wrlkit::gltf
