// The makers behind `tessellate`: one function a node type, which fills job.mesh with faces. Sizes below zero count as
// their absolute value; where no surface is left the mesh has no faces and the fault is reported.
#pragma once
#include <string_view>

#include "geometry/mesh_job.h"
#include "geometry/tessellation.h"

namespace wrlkit {

#define SHAPE(node, maker) void maker(MeshJob& job, const Tessellation& options);
#include "geometry/shapes/makers.def"

/// Of the nodes of our own: forms.
void make_form(MeshJob& job, const Tessellation& options);

/// Leaves the mesh without faces and reports degenerate-geometry.
void report_no_surface(MeshJob& job, std::string_view why);

}  // namespace wrlkit
