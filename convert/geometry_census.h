// What a scene shows, counted: instances multiplied out, finest level of detail, chosen child of a Switch.
#pragma once
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/math/box.h"
#include "geometry/mesh.h"
#include "scenegraph/scene.h"
#include "scenegraph/transform.h"

namespace wrlkit {

struct GeometryCensus {
  std::uint64_t shapes = 0, polygons = 0, triangles = 0, lines = 0, points = 0;
  std::uint64_t unique = 0;  // triangles, those of each geometry once
  Box bounds;                // world, metres
};

/// Counts saturate instead of overflowing: a node may be shown 2^40 times. Each source is asked once for each geometry
/// node: one gives its faces as authored, the other its triangles. O(nodes + points x places); when a scene has
/// millions of places the bounds are those of boxes in boxes.
GeometryCensus count_geometry(const Scene&, const MeshSource& polygons, const MeshSource& triangles);

/// The matrices of all places where a geometry is shown, by its NodeId; false when there are too many (most_visits).
using Places = std::unordered_map<std::uint32_t, std::vector<Matrix>>;
bool find_places(const Scene&, Places&);

}  // namespace wrlkit
