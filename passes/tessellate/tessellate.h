// Every geometry node as a mesh of triangles.
#pragma once
#include "geometry/tessellation.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

using TessellateOptions = Tessellation;

inline constexpr std::string_view tessellate_doc = R"(
Converts every geometry node to a mesh: the faces of Box, Cone, Cylinder, Sphere, Extrusion, ElevationGrid and Text.

    before   Shape { geometry Cylinder { radius 0.1 height 2 } }
    after    Shape { geometry IndexedFaceSet { ... } }           # 20 segments; tessellate{segments=12}: 12

`tolerance` bounds the sagitta: the distance from the middle of a chord to the arc. A circle gets the fewest segments
that keep within it, rounded up to a multiple of four, at least 8 and at most 256. The extreme points on both axes are
therefore exact, and so are the bounds. A Sphere has half as many segments from pole to pole.

With tolerance 0 the sagitta for radius r is 0.005 * sqrt(r): half a per cent of the geometric mean of the radius and
one metre. The number of segments then grows with the fourth root of the radius, from 8 to 64: a bolt of 5 mm gets 12, a
pipe of 0.1 m gets 20, a unit Cylinder 32, a tank of 10 m 56. A scene in millimetres gets more, but never above 64.)";
inline constexpr StatisticInfo tessellate_statistics[] = {
    {"tessellate.shapes", "curved forms that were made into faces"},
    {"tessellate.faces", "faces that were made"},
};

/// Makes job.mesh of any geometry node: geometry/tessellation.h.
Outcome tessellate(MeshJob& job, const TessellateOptions& options);

}  // namespace wrlkit
