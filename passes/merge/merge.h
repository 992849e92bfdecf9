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
Reduces draw calls: merges Shapes that look the same, wherever they are. Each part can still be found by its name.

    before   DEF Unit Transform { translation 5 0 0 children [
               DEF Pump Shape { appearance DEF Steel ... geometry Box {} }
               DEF Tank Shape { appearance USE Steel geometry Sphere {} } ] }
    after    Shape { appearance DEF Steel ... geometry IndexedFaceSet { ...
               metadata MetadataSet { ... "Unit/Pump" "Unit/Tank" ... } } }     # features.h

Shapes that do not move and have equal Appearances are merged into meshes in world coordinates, until at most
`max-draws` are left. If there are no more than that, nothing changes.

- Shapes are grouped by position. Each appearance begins as one cell. While more draw calls are allowed, the cell with
  the most vertices is halved across its longest side. Large parts therefore stay separate, unchanged and shared.
- Merging copies shared geometry to every place. If the writer makes tables of places, `instanced` keeps Shapes with one
  geometry and appearance as they are where that takes less space: about 600 bytes plus 10 per place, compared with 8
  for each point and 0.7 for each corner of every copy. They then take one draw call together, except for mirrored or
  skewed places, which stay separate. The rest is merged even if there are few Shapes, unless a table of another
  appearance uses the same geometry and a cell would be larger. Cells are halved only above 50,000 corners, because each
  cell takes space as well.
- `parts` merges less: no Shape with a name, nothing out of a named group, and no feature ids are made. It merges Shapes
  that cannot be told apart by name where their nodes and meshes take more space than another copy of their vertices: 65
  bytes per node and 280 per mesh. Only geometries with the same name, or none, are merged, and the same holds for their
  Coordinates.
- Each part keeps its name: the DEF names from the root to the Shape. If the Shape has none, or is the first use of its
  geometry, the name of the geometry follows, as in "Unit/Pump". Equal names are numbered ("Bolt#2"). glTF stores a
  feature id for each corner (EXT_mesh_features) and the table of names in extras, X3D stores metadata. VRML97 cannot
  store the names, which is reported. Names of merged nodes, and of groups that become empty, exist only in this table.
  Names of Coordinates and the like are in it as parts without faces.
- The scene looks the same. Normals and default texture coordinates are computed first, and curved forms become faces as
  by `tessellate` with the same `tolerance` and `segments`.
- Not merged across: Anchor, Billboard, Collision, each child of a Switch or LOD, groups with sensors or lights of their
  own, and nodes that a ROUTE moves. Shapes below each of these are merged with each other. Left unchanged: Shapes that
  a ROUTE, Script or IS uses; everything below unknown nodes; geometry with baked light or with levels of detail in the
  file; prototypes.

Later passes that change faces lose the parts: run `weld`, `lod` and `cull` first. Cost: n log n in the Shapes, linear
in the merged geometry, which is stored once for each place.)";
  static constexpr StatisticInfo statistics[] = {
      {"merge.parts", "parts that can still be found by name"},
      {"merge.shapes", "merged Shapes"},
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
    f("csv", csv, "file for a table of the parts that were merged: id, name, appearance");
  }
};

Outcome merge(Scene&, const MergeOptions&, PassContext&);

}  // namespace wrlkit
