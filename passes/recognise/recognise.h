// Pass `recognise`: its documentation is in its options.
#pragma once
#include "passes/pipeline/length_option.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct RecogniseFormsOptions {
  static constexpr std::string_view doc = R"(
Finds simple forms in faces: cylinders, cones and frusta (also eccentric and oblique ones), elbows and rings of round
and rectangular section, spheres, dished heads, boxes, pyramids, flanges, and prisms with any profile, with or without
holes.

    before   Shape { geometry IndexedFaceSet { coord Coordinate { point [ ... 32 points ] } coordIndex [ ... ] } }
    after    Transform { translation 2 0 0 rotation 0 0 1 1.5708
               children Shape { geometry Cylinder { radius 0.1 height 0.4 top FALSE bottom FALSE } } }

The topology is examined first: rings of equally many points, connected by bands of faces, that begin at a cap, a border
or an apex. The form is then fitted and compared with every point and every face. Faces may be polygons or triangles,
with shared or separate points, facing either way. Parts of one IndexedFaceSet are separated even where they touch; a
pipe run made in one piece is cut at its rings. If each face is a Shape, run `join` first.

- A form is used only if it is within `tolerance` of the faces, measured both ways. The default is a fraction of the
  part's own chord error, or the step in which its coordinates were written.
- A form keeps the number of segments of the part, so it is drawn with the same points. `tessellate` with a tolerance
  chooses another number. Walls are smooth and rims are sharp. Sizes are rounded to the step of the coordinates.
- A form that VRML97 has becomes that node: Box, Cone, Cylinder, Extrusion. Other forms become nodes of wrlkit's own
  (docs/nodes.md). `--dump` shows these; all writers write them as faces.
- The Shape moves into a new Transform. Several forms from one Shape move into a new Group, which takes its name.
  Whatever fits no form stays in an IndexedFaceSet next to them.
- Faces of one colour get that colour as diffuseColor of a Material of their own, unless the old Material has a name.
- Left unchanged: parts with several colours; geometry with texture coordinates, textures or baked light; normals that
  differ from those of the form; solid geometry that faces inward; nodes that a ROUTE, Script or IS uses; bodies of
  prototypes; geometry whose name, or the name of whose Coordinate, would be lost.

Cost: linear in the corners.)";
  static constexpr StatisticInfo statistics[] = {
      {"recognise.boxes", "boxes"},
      {"recognise.cones", "cones"},
      {"recognise.cylinders", "cylinders"},
      {"recognise.dishes", "dished heads"},
      {"recognise.forms", "forms in all, each geometry counted once"},
      {"recognise.frusta", "frusta"},
      {"recognise.largest-residual", "largest distance from the original, in micrometres of the world"},
      {"recognise.prisms", "prisms"},
      {"recognise.pyramids", "pyramids"},
      {"recognise.rectangular-tori", "tori of rectangular section"},
      {"recognise.rings", "pipes with a wall, flanges, washers"},
      {"recognise.spheres", "spheres"},
      {"recognise.tori", "elbows and round rings"},
      {"recognise.triangles", "triangles of the faces that became forms"},
      {"recognise.triangles-left", "triangles of the faces that were examined and stay"},
  };

  LengthOption tolerance;
  bool split = true;

  void fields(auto&& f) {
    f("tolerance", tolerance, "maximum distance from the original; 0: chosen for each part");
    f("split", split,
      "split geometry of several parts into several Shapes; false: convert only geometry that is one form as a "
      "whole, which takes the fewest bytes");
  }
};

Outcome recognise(Scene&, const RecogniseFormsOptions&, PassContext&);

}  // namespace wrlkit
