// Pass `weld`: its documentation is in its options.
#pragma once
#include <string>
#include <string_view>

#include "passes/pipeline/pass.h"

namespace wrlkit {

/// A length, or the keyword `auto`.
struct WeldTolerance {
  static constexpr std::string_view type = "length or auto", examples = "0.5mm, 0.0005, auto";
  double length = 0;
  bool automatic = false;

  bool read(std::string_view text);
  std::string print() const;
};

struct WeldOptions {
  static constexpr std::string_view doc = R"(
Joins points that coincide, so that faces know their neighbours, and repairs the faces. Tessellators and CAD exporters
write loose faces; smooth normals, simplification and unwrapping need to know which faces meet.

    before   coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0,  1 0 0, 1 1 0, 0 1 0 ] } coordIndex [ 0 1 2 -1 3 4 5 -1 ]
    after    coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0 ] }                coordIndex [ 0 1 2 -1 1 3 2 -1 ]

Points, normals, colours and texture coordinates are joined separately: two corners may share a point but differ in
their texture coordinate. Seams therefore stay seams.

- By default only equal numbers are joined; -0 equals 0. Normals, colours and texture coordinates are always joined this
  way.
- With a tolerance, a point joins the first point within it that has not joined another one. No point moves farther than
  the tolerance, and the remaining points are farther apart than that. The tolerance is in the coordinates of the
  geometry: metres, unless a Transform above scales them.
- `auto` uses the step of the last printed decimal of the largest coordinates, or that of single precision if it is
  coarser. A Shape smaller than a thousand steps is welded exactly, because a step may be intended there.
- The remaining values are in the order in which the corners use them.

Then the faces are repaired. The repairs run in this order; each is an option and has a count (`--stats`):
- weld.degenerate-faces: faces with fewer than three different points, or without area, are removed. A polygon that
  repeats a corner only loses the repetition (weld.repeated-corners). A mesh that has no other faces stays: it is
  invisible but has an extent.
- weld.duplicate-faces: a face is removed if an earlier one has the same points in the same order, or in the opposite
  order if `solid` is FALSE. A depth buffer would show the earlier one, too. weld.duplicate-triangles counts the same in
  triangles. A sheet that is written once for each side stays.
- weld.t-junctions: a point of an open edge that lies on another open edge, within the tolerance or the rounding error
  of double precision, becomes a corner of the face there. Its normal, colour and texture coordinate are interpolated.
- weld.flipped-faces: in each part that is connected by edges of two faces, faces wound against the majority are
  reversed. In a tie, a closed surface is made to face outward; for others the first face decides. `ccw` is respected. A
  normal that agreed with its face is turned with it. One-sided parts, such as a Moebius strip, do not change
  (weld.one-sided-parts).
- weld.merged-faces: faces are united across edges with equal corners on both sides, if all points are in one plane and
  each normal, colour and texture coordinate is linear over the whole. Polygons that would touch themselves or have a
  hole are not made.

Edges of more than two faces (weld.non-manifold-edges), and points where faces meet without a common edge
(weld.non-manifold-points), are counted and stay. weld.joined-points is the number of points saved.

Lines and points do not change. A mesh pass sees one geometry at a time: run `join` first to weld across Shapes. Cost:
linear in the corners. The same input gives the same result; without a tolerance a second run changes nothing.)";
  static constexpr StatisticInfo statistics[] = {
      {"weld.joined-points", "points saved by joining"},
      {"weld.degenerate-faces", "faces without area removed"},
      {"weld.repeated-corners", "repeated corners removed"},
      {"weld.duplicate-faces", "duplicate faces removed"},
      {"weld.duplicate-triangles", "duplicate faces removed, in triangles"},
      {"weld.t-junctions", "corners added at T-junctions"},
      {"weld.flipped-faces", "faces reversed"},
      {"weld.one-sided-parts", "one-sided parts, which stay"},
      {"weld.merged-faces", "faces saved by uniting neighbours"},
      {"weld.non-manifold-edges", "edges of more than two faces, which stay"},
      {"weld.non-manifold-points", "points where faces meet without a common edge, which stay"},
  };

  WeldTolerance tolerance;
  bool degenerate = true, duplicates = true, t_junctions = true, winding = true;
  bool outward = false, merge_coplanar = false;

  void fields(auto&& f) {
    f("tolerance", tolerance,
      "maximum distance of points that are joined: 1mm, or a number in metres; a Transform above scales it with the "
      "geometry; auto: from the digits of the file");
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
