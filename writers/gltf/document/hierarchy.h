// The nodes of glTF: the transformation hierarchy unrolled, because a node of glTF has one parent. Meshes stay shared.
//
// Every grouping node is a node, with its name (group.h); so is a Shape, except that one without a name that is alone
// in a Transform or Group becomes the mesh of that node (fold.h). Nodes of VRML that draw nothing (sensors, scripts,
// ...) are nodes with extras, in their place. The chosen child of a Switch is there, the others are in extras,
// or nodes that are not visible (GltfOptions::hidden). Levels of a LOD: levels.h. A Background: sky.h.
#pragma once
#include "writers/gltf/document/document.h"
#include "writers/gltf/document/makers.h"

namespace wrlkit::gltf {

/// Everything below the roots of the scene. Reports what glTF has no node for, in one message.
Document build_hierarchy(const Makers&);

/// What a node's translation is beyond the field that it comes from.
Vec3 offset_of(const Document&, const Scene&, std::uint32_t node);

}  // namespace wrlkit::gltf
