// Pass `merge`: its documentation is in its options.
#pragma once
#include <string>

#include "base/option_range.h"
#include "geometry/tessellation.h"
#include "passes/pipeline/pass.h"
#include "passes/pipeline/written_file.h"

namespace wrlkit {

struct MergeOptions {
  static constexpr std::string_view doc = R"(
Few draw calls out of many: Shapes that look the same become one, wherever they stand, and each part can still be
found by its name.

    before   DEF Unit Transform { translation 5 0 0 children [
               DEF Pump Shape { appearance DEF Steel ... geometry Box {} }
               DEF Tank Shape { appearance USE Steel geometry Sphere {} } ] }
    after    Shape { appearance DEF Steel ... geometry IndexedFaceSet { ...
               metadata MetadataSet { ... "Unit/Pump" "Unit/Tank" ... } } }     # features.h

Merges Shapes that are still and have equal Appearances into meshes in the coordinates of the world, until no more
than `max-draws` are drawn. Nothing happens where there are few enough already.

- Which Shapes go together is decided by where they stand: each appearance begins as one cell, and as long as there
  may be more draws, the cell with the most vertices is halved, across its longest side. So large parts stay by
  themselves, as they are, and shared.
- A geometry that is shown often is there once for each place when it is merged. Where the writer makes tables of
  places, `instanced` leaves Shapes of one geometry and appearance as they are if that takes less space: some 600
  bytes and 10 a place, against 8 for each point and 0.7 for each corner of each copy. All of them are one draw then,
  but for places that are mirrored or skewed, which stay by themselves. The rest is merged however few there are,
  unless a table in another look has the same geometry and a cell would take more; and cells are only halved above
  50,000 corners: each one takes space, too.
- `parts` asks for something else: no Shape with a name is merged, nothing is taken out of a group with a name, and
  there are no feature ids. What is merged are Shapes that nobody could tell apart by name, where their nodes and
  meshes would take more space than their vertices do once more: 65 bytes a node, 280 a mesh. Geometries go together
  that have the same name, or none, as their Coordinates do.
- Each part keeps its name: the DEF names from the root to the Shape, and to its geometry if the Shape has none or is
  the first with it, as in "Unit/Pump". Where two parts have one name they are numbered ("Bolt#2"). glTF has a feature
  id for each corner (EXT_mesh_features) and the table in extras; X3D has it as metadata; VRML97 cannot say it, which
  is reported then. Names of what is merged and of the groups that are left without anything in them are only there,
  and names of Coordinates and the like as parts without faces.
- What is drawn does not change: normals are computed before, texture coordinates by the extent of a geometry too, and
  curved forms get their faces as by `tessellate` with the same `tolerance` and `segments`.
- Not merged across: Anchor, Billboard, Collision, each child of Switch and LOD, groups with sensors or lights of
  their own, and what a ROUTE moves; below each of them it is merged. Left alone: Shapes that a ROUTE, a Script or an
  IS touches, and all below nodes that are not known; geometry with baked light or levels of detail in its own file;
  prototypes.

Passes behind it that change faces lose the parts: run `weld`, `lod` and `cull` before. n log n in the Shapes, linear
in what is merged, which is there once for each place.)";
  static constexpr StatisticInfo statistics[] = {
      {"merge.parts", "parts that keep a name"},
      {"merge.shapes", "Shapes that were made"},
      {"merge.draws-before", "Shapes drawn before the pass"},
      {"merge.draws-after", "Shapes drawn after the pass"},
      {"merge.nodes-before", "nodes before the pass"},
      {"merge.nodes-after", "nodes after the pass"},
      {"merge.meshes-before", "geometry nodes drawn before the pass"},
      {"merge.meshes-after", "geometry nodes drawn after the pass"},
  };

  int max_draws = 500;
  bool instanced = false, parts = false;
  Tessellation faces{.triangles = false, .texcoords = true};
  WrittenFile csv{.endings = WrittenFile::table};

  void fields(auto&& f) {
    f("max-draws", max_draws, "maximum number of draw calls, if there are not more appearances and scopes",
      at_least(1));
    f("instanced", instanced,
      "keep Shapes that share geometry often enough for a table of places (--names table, --gpu-instancing)");
    f("parts", parts,
      "instead: merge only Shapes of one part, without names of their own, that look the same, where that makes "
      "compressed glTF smaller");
    faces.fineness_fields(f);
    f("csv", csv, "file for a table of the parts: id, name, appearance");
  }
};

Outcome merge(Scene&, const MergeOptions&, PassContext&);

}  // namespace wrlkit
