// What stands for a surface of a scene at falling numbers of triangles.
#pragma once
#include <vector>

#include "base/math/box.h"
#include "geometry/simplify/surfaces.h"

namespace wrlkit {

/// A surface at one of the levels.
struct SurfaceLevel {
  NodeId geometry;   // none: it has left
  double error = 0;  // in its own units
  std::size_t n_faces = 0;
};

/// A surface, and what stands for it at each level. The first is the surface itself; all have as many.
struct LeveledSurface {
  ShapeSurface surface;
  Box bounds;
  std::vector<SurfaceLevel> levels;
};

}  // namespace wrlkit
