// A grouping node as one node of glTF or, where its transform is more than translation, rotation and scale, as two. A
// Transform whose rotation or scale is animated while it has a center or a scaleOrientation is a chain of nodes, one
// for each part of T C R SR S -SR -C that moves by itself.
#pragma once
#include "writers/gltf/document/document.h"
#include "writers/gltf/document/makers.h"

namespace wrlkit::gltf {

/// Does its rotation or scale move about a point or along axes that a node of glTF does not have?
bool turns_about_a_center(const Makers&, NodeId transform);
/// The topmost of the new nodes. `local`: the transform of the group.
std::uint32_t add_group(Document&, const Makers&, NodeId group, const NodeTransform& local,
                        std::span<const std::uint32_t> children);
/// Animations of `source` move these nodes.
void add_targets(const Makers&, NodeId source, std::uint32_t translation, std::uint32_t rotation, std::uint32_t scale);

}  // namespace wrlkit::gltf
