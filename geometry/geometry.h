// From a geometry node to a Mesh and back. IndexedFaceSet, IndexedLineSet and PointSet are meshes already: their
// indices are read face by face and their positions are borrowed from the scene. All other geometry is made by
// `tessellate`.
//
// Corners keep the order of the file. `ccw FALSE` is not resolved here but kept as mesh.ccw == false: the front of
// each face is then the side from which its corners run clockwise, and whoever needs the front (triangulation keeps
// the order, normals and writers turn it) reverses the corners.
#pragma once
#include "geometry/mesh_job.h"

namespace wrlkit {

/// Fills job.mesh, cleared first, from an IndexedFaceSet, IndexedLineSet or PointSet; any other node leaves kind
/// `none`.
///
/// Costs O(its own indices), whatever the number of points in the Coordinate it uses: exporters write one Coordinate
/// with millions of points and a Shape for each face. Positions stay borrowed from the arena of the scene unless a
/// number in use is not finite; that becomes 0 (not-finite).
///
/// Faces that index a point which does not exist are dropped (bad-index), faces of fewer than three corners too
/// (degenerate-face, degenerate-line); the -1 behind the last face may be missing. Where only triangles (or single
/// segments) are left, face_begin is empty. Attributes that are shorter than the indices need are continued with their
/// last value (short-attribute); a colorIndex, normalIndex or texCoordIndex whose -1 stand elsewhere than those of
/// coordIndex is read face by face. Dropped faces keep their turn: attributes are counted in faces of the file, also
/// the empty ones between -1 and -1. Normals are kept as authored, not normalised.
void read_mesh(MeshJob& job);

/// Writes a mesh into the scene: `geometry` becomes an IndexedFaceSet, IndexedLineSet or PointSet in place, so that
/// every USE of it follows. A Coordinate, Color, Normal or TextureCoordinate whose values are still those of the mesh
/// stays the node that it was, shared or not; changed values go into a new node, because others may use the old one. A
/// mesh of kind `none` changes nothing. What the target cannot hold is dropped: normals and texture coordinates of
/// lines and points.
///
/// read_mesh gives the same mesh again, except for the flag `primitive`, a face_begin that lists only triangles,
/// values that no corner uses, and points that were not in order.
void store_mesh(Scene& scene, NodeId geometry, const Mesh& mesh);

/// By node: geometry that some Shape puts a texture on. O(nodes).
std::vector<char> textured_geometry(const Scene& scene);

}  // namespace wrlkit
