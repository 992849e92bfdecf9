// Positions that are whole numbers become metres by the scale of the nodes that show them.
#pragma once
#include <functional>

#include "writers/gltf/document/document.h"

namespace wrlkit::gltf {

/// Puts it into the node of the mesh where that can be; a node that `keeps` its own transform gets a child for it.
/// `of_mesh`: null where positions are metres already.
void dequantize(Document&, const std::function<const Dequantization*(std::uint32_t mesh)>& of_mesh,
                const std::function<bool(const Node&)>& keeps);

}  // namespace wrlkit::gltf
