// Polygons to triangles.
#pragma once
#include "geometry/mesh_job.h"

namespace wrlkit {

/// Cuts the faces of job.mesh into triangles between their corners; face_begin is empty afterwards. Every corner keeps
/// its normal, colour and texture coordinate, triangles come in the order of their faces and turn the way those do
/// (mesh.ccw is left alone). polygon.h says what is made of concave, touching, crossing and warped polygons.
///
/// - For a quadrilateral, planar and convex, the diagonal is 0-2. A warped one is cut where it folds less.
/// - Faces without area are dropped (degenerate-face): those whose corners are collinear, to within 1e-12 of the square
///   of their longest edge. A triangle that has an area when its coordinates are rounded to single precision stays, as
///   other readers have it.
/// - Within a face no triangle is left without area, and none is dropped that would leave a corner in the middle of an
///   edge.
/// - Concave faces are cut correctly whatever `convex` says; where it says TRUE they are counted (concave-face). Those
///   that cross themselves are counted too (self-touching-face), and so are those that are not planar, in the
///   statistics "triangulate.non-planar".
///
/// Linear in the corners but for large concave faces, and free of allocations. Meshes of lines and points stay as they
/// are. Positions in use must exist. True when the mesh changed.
bool cut_into_triangles(MeshJob& job);

/// Whether a triangle has an area, in the sense above; positions are xyz.
bool has_area(const double* a, const double* b, const double* c);

/// Takes those without area out of a mesh of triangles (Mesh::is_triangles). Positions stay. O(n).
void drop_faces_without_area(Mesh& mesh);

}  // namespace wrlkit
