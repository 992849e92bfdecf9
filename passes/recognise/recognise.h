// Pass `recognise`: its documentation is in its options.
#pragma once
#include "passes/pipeline/length_option.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct RecogniseFormsOptions {
  static constexpr std::string_view doc = R"(
What parts are, found in their faces: cylinders, cones and frusta (eccentric and slanted ones, too), elbows and rings of
round and rectangular section, spheres, dished heads, boxes, pyramids, flanges, and prisms with any profile, with holes
or without.

    before   Shape { geometry IndexedFaceSet { coord Coordinate { point [ ... 32 points ] } coordIndex [ ... ] } }
    after    Transform { translation 2 0 0 rotation 0 0 1 1.5708
               children Shape { geometry Cylinder { radius 0.1 height 0.4 top FALSE bottom FALSE } } }

By topology first: rings of equally many points with bands of faces between them, from a cap, a border or an apex. Then
by a fit, which is compared with every point and every face of the part. Faces may be polygons or triangles, may share
points, and may point outwards or inwards; equal points count as one. Parts in one IndexedFaceSet are separated even
where they touch; a pipe run in one piece is cut at its rings. Run `join` first where each face is a Shape.

- Nothing is replaced by a form that is farther away than `tolerance`, both ways. By default that is a
  fraction of the chord error that the part itself shows, or the step in which its coordinates were written.
- A form keeps the number of segments that the part had, so that it is drawn with the same points; `tessellate` with a
  tolerance chooses another number. Walls are smooth, rims sharp. Sizes are rounded to the step of the coordinates.
- Where VRML97 has the form it becomes that node: Box, Cone, Cylinder, Extrusion. Other forms are nodes of our own
  (docs/nodes.md), which `--dump` shows and all writers write as faces.
- The Shape stands in a new Transform, several forms of one Shape in a new Group that takes its name; what fits no form
  stays an IndexedFaceSet next to them.
- Faces of one colour get it as the diffuseColor of a Material of their own, where the Material that was there has no
  name.
- Left alone: parts of several colours; texture coordinates, baked light and textures; normals that are not those of the
  form; faces that point inwards and are solid; what a ROUTE, a Script or an IS touches; bodies of prototypes; geometry
  whose name or whose Coordinate's name would be lost.

Linear in the corners.)";
  static constexpr StatisticInfo statistics[] = {
      {"recognise.boxes", "boxes"},
      {"recognise.cones", "cones"},
      {"recognise.cylinders", "cylinders"},
      {"recognise.dishes", "dished heads"},
      {"recognise.forms", "forms in all, each geometry counted once"},
      {"recognise.frusta", "frusta"},
      {"recognise.largest-residual", "largest distance from what was there, in micrometres of the world"},
      {"recognise.prisms", "prisms"},
      {"recognise.pyramids", "pyramids"},
      {"recognise.rectangular-tori", "tori of rectangular section"},
      {"recognise.rings", "pipes with a wall, flanges, washers"},
      {"recognise.spheres", "spheres"},
      {"recognise.tori", "elbows and round rings"},
      {"recognise.triangles", "triangles of the faces that are forms now"},
      {"recognise.triangles-left", "triangles of faces that were looked at and stay"},
  };

  LengthOption tolerance;
  bool split = true;

  void fields(auto&& f) {
    f("tolerance", tolerance, "maximum distance from the original, in metres; 0: chosen for each part");
    f("split", split,
      "split geometry of several parts into several Shapes; false: convert only geometry that is one form as a "
      "whole, which takes the fewest bytes");
  }
};

Outcome recognise(Scene&, const RecogniseFormsOptions&, PassContext&);

}  // namespace wrlkit
