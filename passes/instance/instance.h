// Pass `instance`: its documentation is in its options.
#pragma once
#include <string>
#include <string_view>

#include "base/choice.h"
#include "base/option_range.h"
#include "passes/instance/form.h"
#include "passes/pipeline/pass.h"

namespace wrlkit {

template <>
inline constexpr auto choices<instancing::Scaling> =
    choice_row({{"none"}, {"uniform", "by one factor"}, {"axis", "by a factor for each of three axes"}});

struct InstanceOptions {
  static constexpr std::string_view doc = R"(
The same part in many places, written again for each: found and written once. CAD exporters know no DEF and USE, and
put the coordinates of each bolt where it stands.

    before   Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 2 0 ] } ... } }
             Shape { geometry IndexedFaceSet { coord Coordinate { point [ 5 0 0, 5 1 0, 3 0 0 ] } ... } }
    after    Shape { geometry DEF _1 IndexedFaceSet { ... } }
             Transform { translation 5 0 0 rotation 0 0 1 1.570796 children Shape { geometry USE _1 } }

Shares geometry (IndexedFaceSet, IndexedLineSet, PointSet) that is the same but for a rotation, a translation and a
scale: the first keeps its geometry, the Shapes of the others stand in a new Transform and USE it.

- Found without names and in any order of faces, points and corners, with points shared or not. Meshes are compared by
  what a motion does not change, then vertex by vertex. Every corner is within `tolerance` of where it was, in the
  largest of its places; its colour is the same, its normal within 0.3 degrees, its texture coordinate within 0.00001.
  ccw, solid, convex and creaseAngle agree. `axis` finds only copies whose corners stand in the same order, and needs
  normals in the file or a creaseAngle of 0.
- A mirror image has its faces the other way round, and a scale with a negative factor turns them.
- `forms`: a pipe is a cylinder of radius and height 1 and a scale. Boxes, cylinders, rings and prisms are scaled along
  and across their axis, others by one factor; all the same ratios, segments and caps.
- Geometry far from its origin, where single precision is coarser than the tolerance, is moved to the origin, and its
  own Shape gets a Transform, too.
- Not worth it: what saves less than `min-saving` bytes over all copies. A vertex is 24 bytes, an index 2, a Transform
  150.
- The DEF name of a geometry goes to the Transform. Shapes keep theirs, and groups stay as they are.
- Left alone: what a ROUTE, a Script or an IS touches; geometry with baked light; textures that lie by the extent of
  the geometry; Shapes that are held otherwise than by a group; bodies of prototypes.

Run `weld`, and for one Shape a face `join`, before it. Names that go are reported (names-lost). Expected linear in the
corners, n log n where copies differ in their order.)";
  static constexpr StatisticInfo statistics[] = {
      {"instance.groups", "geometries that are shared now"},
      {"instance.copies", "geometries that are no more"},
      {"instance.forms", "of those, forms"},
      {"instance.draws-before", "Shapes drawn before the pass"},
      {"instance.draws-after", "Shapes drawn after the pass"},
      {"instance.nodes-before", "nodes before the pass"},
      {"instance.nodes-after", "nodes after the pass"},
      {"instance.meshes-before", "geometry nodes drawn before the pass"},
      {"instance.meshes-after", "geometry nodes drawn after the pass"},
  };

  double tolerance = 0.0002;
  instancing::Scaling scaling = instancing::Scaling::uniform;
  bool mirror = false, named = false, forms = false;
  double min_saving = 1000;
  int form_places = 0;

  void fields(auto&& f) {
    f("tolerance", tolerance, "maximum distance of a point from where it was, in metres", at_least(0));
    f("scaling", scaling, "scaling of copies");
    f("mirror", mirror, "also mirror images, by a negative scale, which VRML97 does not allow");
    f("named", named, "also geometry whose Coordinate or the like has a DEF name, which is lost");
    f("forms", forms, "also Box, Cylinder and the forms of recognise: forms that differ only in scale become one");
    f("form-places", form_places,
      "forms in more places than this keep geometry of their own size, which takes less than a scale at each place; "
      "0: unlimited",
      at_least(0));
    f("min-saving", min_saving, "bytes of glTF that a group of equal parts must save to be shared");
  }
};

Outcome instance(Scene&, const InstanceOptions&, PassContext&);

}  // namespace wrlkit
