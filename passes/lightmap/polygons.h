// The polygons of a mesh that was cut into triangles, as far as they still are whole.
#pragma once
#include "geometry/mesh.h"

namespace wrlkit::bake {

/// Puts the triangles of each face together again (Mesh::cut says which they are; behind the faces their backs may
/// follow in the same order) where they meet in the same values of all attributes: a face that lies in several charts
/// stays cut, and so does a concave one of a mesh that says that all are convex. n log n in the corners of a face.
void join_cut_faces(Mesh& mesh);

}  // namespace wrlkit::bake
