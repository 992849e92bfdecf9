// Fewer nodes: a group and its only child are one node where that makes no difference.
#pragma once
#include "writers/gltf/document/document.h"
#include "writers/gltf/document/makers.h"

namespace wrlkit::gltf {

/// Makes the only child of a Transform or Group the node of that group, where nothing is lost; false: it stays a child.
/// A lone Shape without a name and with nothing of its own to say becomes the mesh of its group. Where only facts are
/// kept, so does any group or Shape, when only one of the two has a name and their transforms are one.
bool fold(Document&, const Makers&, NodeId group, const NodeTransform& local, std::uint32_t child);
/// It would not be missed: no name, nothing in it, and only facts are kept.
bool says_nothing(const Makers&, const Node&);

/// Groups that do something that glTF cannot do.
bool does_something(const Scene&, NodeId);

}  // namespace wrlkit::gltf
