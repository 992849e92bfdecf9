// How far each point of a surface is from another surface, to be shown as colours: a mesh whose vertices carry the
// distance.
#pragma once
#include <string>

#include "geometry/closest_point.h"

namespace wrlkit {

/// The mesh of `surface` with the distance of each vertex from `other`, as bytes for the viewer page
/// (viewer/src/compare/heat.ts), little endian:
///
///   u32 vertices, u32 triangles, 3 x f64 origin, f32 x y z of each vertex from the origin, f32 distance of each vertex
///   in metres, 3 x u32 corners of each triangle
///
/// Triangles in whose middle the distance is larger than at their corners are cut into smaller ones, `most` in all.
/// Runs on all threads with the same result on any number. O(n log n).
std::string deviation_map(const Triangles& surface, const Triangles& other, std::size_t most = 400'000);

}  // namespace wrlkit
