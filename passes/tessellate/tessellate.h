// Every geometry node as a mesh of triangles.
#pragma once
#include "geometry/tessellation.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

using TessellateOptions = Tessellation;

/// Makes job.mesh of any geometry node: geometry/tessellation.h.
Outcome tessellate(MeshJob& job, const TessellateOptions& options);

}  // namespace wrlkit
