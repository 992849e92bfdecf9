// Geometry of X3D as that of VRML97.
#pragma once
#include "scenegraph/scene.h"

namespace wrlkit::x3d {

/// Turns one geometry node that only X3D has into an IndexedFaceSet, IndexedLineSet or PointSet. False: it is another
/// node.
bool lower_geometry(Scene&, NodeId);

/// The fields of `n` that a node of `type` has under the same name, and those that no type has.
std::vector<Value> fields_for(const Scene&, NodeId n, TypeId type);

}  // namespace wrlkit::x3d
