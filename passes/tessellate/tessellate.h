// Every geometry node as a mesh of triangles.
#pragma once
#include "geometry/tessellation.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

using TessellateOptions = Tessellation;

inline constexpr std::string_view tessellate_doc = R"(
Every geometry node becomes a mesh: the faces of Box, Cone, Cylinder, Sphere, Extrusion, ElevationGrid and Text.

A circle of radius r gets the fewest segments whose sagitta (the distance from the middle of a chord to the arc) stays
within the tolerance, rounded up to a multiple of four so that the extreme points on both axes, and with them the
bounds, are exact; at least 8, at most 256. A Sphere has half as many from pole to pole.

With tolerance 0 the sagitta is 0.005 * sqrt(r): half a per cent of the geometric mean of the radius and one metre.
The segments then grow with the fourth root of the radius, between 8 and 64, so that a bolt of 5 mm gets 12, a pipe of
0.1 m 20, a unit Cylinder 32, a tank of 10 m 56; in a world written in millimetres they are finer, but never beyond
64.)";
inline constexpr StatisticInfo tessellate_statistics[] = {
    {"tessellate.shapes", "curved forms that were made into faces"},
    {"tessellate.faces", "faces that were made"},
};

/// Makes job.mesh of any geometry node: geometry/tessellation.h.
Outcome tessellate(MeshJob& job, const TessellateOptions& options);

}  // namespace wrlkit
