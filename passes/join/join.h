// Pass `join`: its documentation is in its options.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

struct JoinOptions {
  static constexpr std::string_view doc = R"(
One Shape for what an exporter wrote as many. CAD systems write a Shape for each face, thousands of which re-use one
Appearance and one big Coordinate; every one of them is a draw call, and no pass that works on a mesh sees more than a
face.

    before   Group { children [
               Shape { appearance DEF Steel Appearance { ... }
                       geometry IndexedFaceSet { coord DEF All Coordinate { ... } coordIndex [ 0 1 2 -1 ] } }
               Shape { appearance USE Steel geometry IndexedFaceSet { coord USE All coordIndex [ 2 1 3 -1 ] } } ] }
    after    Group { children
               Shape { appearance DEF Steel Appearance { ... }
                       geometry IndexedFaceSet { coord DEF All Coordinate { ... } coordIndex [ 0 1 2 -1 2 1 3 -1 ] } } }

Joins Shapes that are children of one grouping node, or stand at the top of the file, if
- their Appearances are the same node or say the same;
- their geometries are all IndexedFaceSet, all IndexedLineSet or all PointSet, agree in ccw, solid, convex and
  creaseAngle, and have the same of colours, normals and texture coordinates;
- Shape and geometry are used in one place, have no DEF name, and neither they nor what they hold are touched by a
  ROUTE, a Script, a prototype instance or an IS;
- a texture does not lie on them by default coordinates, which depend on the extent of the geometry.

The first of them becomes the joined one, in its place among the children. A Coordinate with a name, or one that is
used several times, stays the node that it is: Shapes that share it are joined among themselves, and not a point is
copied. Of other points, and of colours, normals and texture coordinates, those in use are put behind one another, and
the names of nodes that held the latter are lost. Values that are equal are left for `weld`.

Children of Switch and LOD are alternatives and stay apart. Leaves empty groups as they were, and nodes that nobody
holds any more. Faces that share a Coordinate are neighbours when they are joined, and smooth if creaseAngle says so.
Linear in nodes and in the indices of what is joined.)";
  static constexpr StatisticInfo statistics[] = {
      {"join.shapes", "how many Shapes fewer there are"},
      {"join.draws-before", "Shapes drawn before the pass"},
      {"join.draws-after", "Shapes drawn after the pass"},
      {"join.nodes-before", "nodes before the pass"},
      {"join.nodes-after", "nodes after the pass"},
      {"join.meshes-before", "geometry nodes drawn before the pass"},
      {"join.meshes-after", "geometry nodes drawn after the pass"},
  };

  bool named = false;

  void fields(auto&& f) {
    f("named", named, "also join Shapes with a DEF name, if no ROUTE or Script uses it; the name is lost");
  }
};

Outcome join(Scene&, const JoinOptions&, PassContext&);

}  // namespace wrlkit
