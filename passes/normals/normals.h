// Pass `normals`: its documentation is in its options.
#pragma once
#include "base/option_range.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct NormalsOptions {
  static constexpr std::string_view doc = R"(
Normals of a mesh that has none, by the creaseAngle of ISO/IEC 14772-1, 4.6.3.5: two faces that share an edge are
shaded smoothly across it where the angle between their geometric normals is less than creaseAngle; otherwise the edge
is a crease.

    before   IndexedFaceSet { creaseAngle 0.5 coord Coordinate { point [ ... ] } coordIndex [ ... ] }
    after    the same with Normal { vector [ ... ] } and a normalIndex for each corner

Geometric normals are Newell's: polygons may be concave, not planar, or of any number of corners. With `ccw FALSE` the
front is the side from which the corners run clockwise, and all normals are the opposite of Newell's.

Gives each corner of a mesh of faces its unit normal; equal normals share one value, where they lie not too far apart.
The corners around a position are grouped by the edges that their faces share, and take the sum of the normals of
these faces, each weighted by its angle at that position.

- Edges are shared where they have the same two positions by index; points that merely coincide are not joined.
- creaseAngle 0 (or less, or not a number): one normal for each face. pi or more: every shared edge is smooth.
- An edge of more than two faces is smooth between any two of them that are within creaseAngle; of the tenth face on,
  each is compared with the eight before it only. So a sheet that is given twice, once for each side, is two smooth
  sheets, and a wall that stands on a smooth floor does not disturb the floor.
- Normals are not turned where neighbours are wound against each other: by the standard's words these normals differ
  by nearly pi, and the edge is a crease.
- A face without area takes the normal of a neighbour across an edge, or (0, 0, 1), and adds nothing to a sum. Where a
  sum cancels out, the first face of the group gives its normal.

Changes nothing in meshes of lines or points. Linear in the corners: neither a position that a hundred thousand faces
share nor the millions of positions that the mesh does not use cost more. Positions in use must exist.)";

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
