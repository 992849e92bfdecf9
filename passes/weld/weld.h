// Pass `weld`: its documentation is in its options.
#pragma once
#include <string>
#include <string_view>

#include "passes/pipeline/pass.h"

namespace wrlkit {

/// A length, or the keyword `auto`.
struct WeldTolerance {
  static constexpr std::string_view type = "number or auto";
  double length = 0;
  bool automatic = false;

  bool read(std::string_view text);
  std::string print() const;
};

struct WeldOptions {
  static constexpr std::string_view doc = R"(
Topology recovery: from faces that have their points to themselves to faces that share them. Tessellators and CAD
exporters write loose faces; whatever walks over a surface (smooth normals, simplification, unwrapping) needs to know
which of them meet.

    before   coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0,  1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 3 4 5 -1 ]
    after    coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0 ] }                coordIndex [ 0 1 2 -1 1 3 2 -1 ]

Then what is wrong with the faces that now meet is repaired, and counted in the statistics ("weld.flipped-faces").

Joins the points of job.mesh, and its normals, colours and texture coordinates, each by themselves: a corner may agree
with its neighbour in one and not in the other, and what was a seam stays one.

- Exact, which is the default: numbers that are equal are joined, -0 and 0 are. Normals, colours and texture
  coordinates are always joined like that.
- With a tolerance, a point joins the first point within the tolerance that did not itself join another. So nothing
  moves farther than the tolerance, and the points that are left are farther apart than that. The tolerance is in
  units of the geometry's own coordinates: metres unless a Transform above scales them.
- `auto` takes the step of the last decimal that the coordinates are printed with, from the largest of them, or that
  of single precision if coarser; and joins nothing that is not equal where the shape is small, below a thousand
  steps: there a step may be meant.
- What is left comes in the order in which the corners first use it.

The repairs, in their order; each is an option, and a count in the statistics:
- weld.degenerate-faces: fewer than three different points, or no area (as `triangulate` sees it). A polygon only
  loses the corners that repeat the one before (weld.repeated-corners). A mesh of nothing but such faces is kept: it
  is not seen, but has an extent.
- weld.duplicate-faces: the same points in the same order as an earlier face; in the opposite order too where `solid`
  is FALSE. The earlier one stays, as a depth buffer would have it. weld.duplicate-triangles counts them as triangles.
  A sheet given twice, once for each side, stays.
- weld.t-junctions: corners added. A point of an open edge that lies on another open edge, within the tolerance (or
  the rounding error of double precision), becomes a corner of the face there; its normal, colour and texture
  coordinate are interpolated along the edge.
- weld.flipped-faces: within each part that hangs together by edges of two faces, those that are wound against the
  majority are reversed, at a tie those that make a closed surface face outward, or that disagree with the first face.
  `ccw` is respected. A normal that agreed with its face is turned with it. Parts with one side only (Moebius) are
  left alone (weld.one-sided-parts).
- weld.merged-faces: how many faces fewer there are. Faces are united across edges with equal corners on both sides,
  where all points lie in one plane and each normal, colour and texture coordinate is linear over the whole. Polygons
  that would touch themselves or go round a hole are not made.

Kept and counted: weld.non-manifold-edges, of more than two faces, and weld.non-manifold-points, where faces meet that
hang together by no edge there. weld.joined-points counts what joining saved.

Meshes of lines and points stay as they are. Needs no other pass; `join` before it brings faces into one geometry, as
a mesh pass sees one at a time. Linear in the corners. Same input, same result; a second run changes nothing, without
a tolerance.)";
  static constexpr StatisticInfo statistics[] = {
      {"weld.joined-points", "points that joining saved"},
      {"weld.degenerate-faces", "faces without area that were dropped"},
      {"weld.repeated-corners", "corners that repeated the one before"},
      {"weld.duplicate-faces", "faces that were there already"},
      {"weld.duplicate-triangles", "the same, as triangles"},
      {"weld.t-junctions", "corners that were added"},
      {"weld.flipped-faces", "faces that were turned"},
      {"weld.one-sided-parts", "parts with one side only, which are left alone"},
      {"weld.merged-faces", "how many faces fewer there are"},
      {"weld.non-manifold-edges", "edges of more than two faces, which are kept"},
      {"weld.non-manifold-points", "points where parts meet that share no edge there, which are kept"},
  };

  WeldTolerance tolerance;
  bool degenerate = true, duplicates = true, t_junctions = true, winding = true;
  bool outward = false, merge_coplanar = false;

  void fields(auto&& f) {
    f("tolerance", tolerance,
      "maximum distance of points that are joined, in units of the geometry; auto: from the digits of the file");
    f("degenerate", degenerate, "remove faces without area, and repeated corners");
    f("duplicates", duplicates, "remove duplicate faces");
    f("t-junctions", t_junctions, "insert points that lie on the open edge of a face into that face");
    f("winding", winding, "turn faces that are wound against their neighbours");
    f("outward", outward, "turn closed surfaces that are inside out");
    f("merge-coplanar", merge_coplanar, "unite neighbours in one plane, where that gives a simple polygon");
  }
};

Outcome weld(MeshJob& job, const WeldOptions& options);

}  // namespace wrlkit
