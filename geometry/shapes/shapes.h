// The makers behind `tessellate`: the functions that the node table names (mesh=...), which fill job.mesh with faces.
// Sizes below zero count as their absolute value; where no surface is left the mesh has no faces and the fault is
// reported.
#pragma once
#include <string_view>

#include "geometry/mesh_job.h"
#include "geometry/tessellation.h"

namespace wrlkit {

#define SHAPE(node, maker) void maker(MeshJob& job, const Tessellation& options);
#include "scenegraph/shape_makers.def"

/// Leaves the mesh without faces and reports degenerate-geometry.
void report_no_surface(MeshJob& job, std::string_view why);

}  // namespace wrlkit
