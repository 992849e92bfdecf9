// Every geometry node as a mesh of triangles.
#pragma once
#include "geometry/tessellation.h"
#include "passes/pipeline/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct TessellateOptions : Tessellation {
  void fields(auto&& f) {
    f("tolerance", tolerance, "largest distance between a curved surface and its faces, in metres; 0: by the size", at_least(0));
    f("segments", segments, "faces around Cone, Cylinder and Sphere; 0: by the tolerance", between(0, 4096));
    f("triangles", triangles, "cut all faces into triangles");
    f("texcoords", texcoords, "make the default texture coordinates where a texture needs them and the file has none");
  }
};

/// Makes job.mesh of any geometry node: geometry/tessellation.h.
Outcome tessellate(MeshJob& job, const TessellateOptions& options);

}  // namespace wrlkit
