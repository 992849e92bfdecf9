// Normals of faces by a crease angle (ISO/IEC 14772-1, 4.6.3.5); passes/normals/normals.h says precisely which.
#pragma once
#include "geometry/mesh_job.h"

namespace wrlkit {

/// Gives each corner of a mesh of faces its unit normal, in place of those that it has; `crease_angle` in radians.
/// Positions in use must exist. O(corners).
void make_normals(Mesh& mesh, MeshScratch& scratch, double crease_angle);

}  // namespace wrlkit
