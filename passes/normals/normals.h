// Pass `normals`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct NormalsOptions {
  static constexpr std::string_view doc = R"(
Computes missing normals from creaseAngle (ISO/IEC 14772-1, 4.6.3.5). An edge is smooth if the angle between the normals
of its two faces is less than creaseAngle; otherwise it is a crease.

    before   IndexedFaceSet { creaseAngle 0.5 coord Coordinate { point [ ... ] } coordIndex [ ... ] }
    after    the same with Normal { vector [ ... ] } and a normalIndex for each corner

Face normals follow Newell's method, so polygons may be concave, non-planar and of any size. With `ccw FALSE` the front
is the side from which the corners run clockwise, and all normals are reversed.

Each corner gets a unit normal; equal normals that are close together in the list share one value. The corners at a
point are grouped by the edges that their faces share. A group gets the sum of its face normals, each weighted by the
angle of the face at that point.

- An edge is shared if its two points have the same indices. Points that merely coincide are not joined.
- creaseAngle 0, a negative one or NaN gives one normal for each face. With pi or more, every shared edge is smooth.
- At an edge of more than two faces, any two faces within creaseAngle are smooth. From the tenth face on, a face is
  compared only with the eight before it. A sheet that is written once for each side is therefore two smooth sheets, and
  a wall on a smooth floor does not disturb the floor.
- Neighbours that are wound against each other are not corrected: by the standard their normals differ by nearly pi, and
  the edge is a crease.
- A face without area takes the normal of a neighbour, or (0, 0, 1), and adds nothing to sums. If a sum cancels out, the
  normal of the first face of the group is used.

Lines and points do not change. Cost: linear in the corners, also if a hundred thousand faces share a point, or if the
mesh has millions of unused points. Points that are used must exist.)";

  bool recompute = false;    // primitives keep theirs, which are exact
  double crease_angle = -1;  // negative: what the mesh says

  void fields(auto&& f) {
    f("recompute", recompute, "replace the normals of the file, too");
    f("crease-angle", crease_angle, "crease angle in radians, instead of that of the file; negative: that of the file",
      between(-1, 3.1416));
  }
};

Outcome normals(MeshJob& job, const NormalsOptions& options);

}  // namespace wrlkit
