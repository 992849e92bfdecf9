// Pass `join`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct JoinOptions {
  static constexpr std::string_view doc = R"(
Joins Shapes that look the same. CAD systems often write one Shape per face, thousands of them with the same Appearance
and one big Coordinate. Each is a draw call, and passes that work on a mesh see only a single face.

    before   Group { children [
               Shape { appearance DEF Steel Appearance { ... }
                       geometry IndexedFaceSet { coord DEF All Coordinate { ... } coordIndex [ 0 1 2 -1 ] } }
               Shape { appearance USE Steel geometry IndexedFaceSet { coord USE All coordIndex [ 2 1 3 -1 ] } } ] }
    after    Group { children
               Shape { appearance DEF Steel Appearance { ... }
                       geometry IndexedFaceSet { coord DEF All Coordinate { ... } coordIndex [ 0 1 2 -1 2 1 3 -1 ] } } }

Shapes in the same group, or at the top of the file, are joined if
- their Appearances are the same node or have the same values;
- their geometries are all IndexedFaceSet, all IndexedLineSet or all PointSet, with the same ccw, solid, convex and
  creaseAngle, and all have or all lack colours, normals and texture coordinates;
- Shape and geometry have one use and no DEF name, and no ROUTE, Script, prototype instance or IS reaches them or their
  contents;
- nothing is known of them that no viewer shows, such as metadata;
- no texture is mapped by the default coordinates, which depend on the extent of the geometry.

With `loose` only single faces become one, and only where they touch: the faces of one part. Parts that look alike stay
apart, for levels of detail weigh parts against each other. `simplify` and `tiles` do so by default.

The joined Shape takes the place of the first one. A Coordinate that has a name or several uses stays: the Shapes that
share it are joined with each other, and no point is copied. Other points, colours, normals and texture coordinates are
concatenated; values that are not used are left out, and names of the concatenated nodes are lost. Equal values are left
to `weld`.

Children of a Switch or LOD are alternatives and are not joined. Groups that become empty stay, and so do nodes that are
no longer used. Joined faces that share a Coordinate are neighbours, and are shaded smoothly if creaseAngle says so.
Cost: linear in the nodes and in the joined indices.)";
  static constexpr StatisticInfo statistics[] = {
      {"join.shapes", "Shapes saved"},
      {"join.draws-before", "Shapes drawn before the pass"},
      {"join.draws-after", "Shapes drawn after the pass"},
      {"join.nodes-before", "nodes before the pass"},
      {"join.nodes-after", "nodes after the pass"},
      {"join.meshes-before", "geometry nodes drawn before the pass"},
      {"join.meshes-after", "geometry nodes drawn after the pass"},
  };

  bool named = false, loose = false;

  void fields(auto&& f) {
    f("named", named, "also join Shapes with a DEF name, if no ROUTE or Script uses it; the name is lost");
    f("loose", loose,
      "only join loose faces: Shapes of up to four faces that have points in common, directly or by way of others");
  }
};

Outcome join(Scene&, const JoinOptions&, PassContext&);

}  // namespace wrlkit
