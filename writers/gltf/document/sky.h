// The Shapes of a Background (pass `sky`) as a dome around the world.
#pragma once
#include <span>

#include "writers/gltf/document/document.h"

namespace wrlkit::gltf {

/// What a Background or TextureBackground is shown by; none of other nodes.
std::span<const NodeId> sky_shapes(const Scene&, NodeId);

/// Puts the node of the sky around the world and all cameras, half as far again as they reach. Does nothing without
/// one. The world does not grow by it.
void place_sky(Document&);

}  // namespace wrlkit::gltf
