// A scene as a tree of cells, each with coarser levels of all that is in it (HLOD): what is far away is a few meshes.
#pragma once
#include "geometry/simplify/lod_nodes.h"
#include "geometry/simplify/world.h"

namespace wrlkit {

struct CellLodOptions {
  WorldSimplifyOptions world;      // ratios: of the levels of the smallest cells
  std::size_t triangles = 50'000;  // of a cell that is not cut, and of the one level of another
  Tessellation faces;
  LodLimits limits;
};

/// Cuts what never moves into cells (geometry/space_cells.h) and puts it below a tree of LODs at the end of the roots;
/// the rest stays where it is. `scene` is replaced, unless there is nothing worth it. A level of a cell is one mesh for
/// each look, with the names of its parts (scenegraph/features.h). O(n log n) in the triangles.
LodCounts add_cell_lods(Scene& scene, const CellLodOptions& options, Task& ctx);

}  // namespace wrlkit
