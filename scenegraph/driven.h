// Geometry that its own fields do not fully define: the field of a prototype, an event or a Script gives it values.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

bool is_geometry(const Scene& scene, NodeId n);

/// By node: geometry with a field IS (ISO/IEC 14772-1, 4.8.3), that a ROUTE begins or ends at, that is exported or that
/// a Script holds, or whose Coordinate, Color, Normal, ... is such a node. Whoever gives it other points, other indices
/// or another type takes it away from them. O(nodes).
std::vector<char> driven_geometry(const Scene& scene);

}  // namespace wrlkit
