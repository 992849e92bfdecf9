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
Finds geometry that is repeated at other places, and stores it once. CAD exporters often do not use DEF and USE: they
write the coordinates of each bolt where it stands.

    before   Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 2 0 ] } ... } }
             Shape { geometry IndexedFaceSet { coord Coordinate { point [ 5 0 0, 5 1 0, 3 0 0 ] } ... } }
    after    Shape { geometry DEF _1 IndexedFaceSet { ... } }
             Transform { translation 5 0 0 rotation 0 0 1 1.570796 children Shape { geometry USE _1 } }

IndexedFaceSet, IndexedLineSet and PointSet are shared if they are equal after a rotation, a translation and a scale.
The first one keeps its geometry. The Shapes of the others move into a new Transform and USE it.

- Names are not needed, and faces, points and corners may be in any order, with shared or separate points. Meshes are
  compared by properties that a motion does not change, and then vertex by vertex. Every corner must be within
  `tolerance` at its largest place; colours must be equal, normals within 0.3 degrees, texture coordinates within
  0.00001. ccw, solid, convex and creaseAngle must agree. `axis` finds only copies with their corners in the same order,
  and needs normals in the file or a creaseAngle of 0.
- In a mirror image the faces are wound the other way. A scale with a negative factor turns them back.
- `forms`: a pipe becomes a cylinder of radius and height 1 with a scale. Boxes, cylinders, rings and prisms are scaled
  along and across their axis, other forms by one factor. Ratios, segments and caps must be the same.
- Geometry so far from its origin that single precision is coarser than the tolerance is moved to the origin, and its
  own Shape gets a Transform as well.
- A group of equal parts is shared only if that saves at least `min-saving` bytes. A vertex counts as 24 bytes, an index
  as 2, a Transform as 150.
- The DEF name of a geometry moves to the Transform. Shapes and groups keep theirs.
- Left unchanged: nodes that a ROUTE, Script or IS uses; geometry with baked light; textures that are mapped by the
  extent of the geometry; Shapes that are not children of a group; bodies of prototypes.

Run `weld` first and, if each face is a Shape, `join`. Lost names are reported (names-lost). Cost: usually linear in the
corners, n log n where copies differ in their order.)";
  static constexpr StatisticInfo statistics[] = {
      {"instance.groups", "geometries that are now shared"},
      {"instance.copies", "geometries that were replaced by a shared one"},
      {"instance.forms", "forms among them"},
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
    f("tolerance", tolerance, "maximum distance of a point from where it was", a_length());
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
