// A mesh in another frame.
#pragma once
#include "geometry/mesh.h"
#include "scenegraph/transform.h"

namespace wrlkit {

/// Puts a mesh behind what is in `all`, which takes over kind, solid and the width of colours from the first. Points
/// and values are those of the corners, in their order. Faces that a mirroring frame turns inside out, and those of ccw
/// FALSE, run the other way then. False, and nothing added,
/// where indices could not count it. O(corners); `map` is scratch.
bool append_moved(Mesh& all, const Mesh& mesh, const Matrix& frame, StampedMap& map);

}  // namespace wrlkit
