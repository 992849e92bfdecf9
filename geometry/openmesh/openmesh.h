// Polygons with corner attributes as a mesh of OpenMesh, and back: the component wrlkit::openmesh, and the one header
// that includes OpenMesh. It is there when wrlkit was built with OpenMesh.
//
//   ToOpenMesh given = to_openmesh(mesh);   // given.mesh is an OpenMesh PolyMesh, given.apart what it cannot hold
//   ...                                     // any tool of OpenMesh
//   Mesh result = from_openmesh(given.mesh);
#pragma once
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <vector>

#include "geometry/mesh.h"
#include "geometry/openmesh/face_adder.h"

namespace wrlkit {

struct OpenMeshTraits : OpenMesh::DefaultTraits {
  typedef OpenMesh::Vec3d Point;
  typedef OpenMesh::Vec3d Normal;
  typedef OpenMesh::Vec2f TexCoord2D;
  typedef OpenMesh::Vec4f Color;
};
using OpenMeshPolygons = OpenMesh::PolyMesh_ArrayKernelT<OpenMeshTraits>;

/// Name of the half-edge property (Vec2f) with the places in a lightmap.
constexpr const char* openmesh_lightcoord = "wrlkit:lightcoord";

struct ToOpenMesh {
  OpenMeshPolygons mesh;
  std::vector<std::uint32_t> position_of;  // by vertex: its position in the Mesh
  std::vector<std::uint32_t> face_of;      // by face: its number in the Mesh
  Mesh apart;                              // the faces that it does not hold, with what they use
  NotManifold faults;                      // why
};

/// Vertices are the positions that faces use, in the order in which corners first use them; faces keep their order and
/// their first corner. A corner's normal, colour (opaque where there is no alpha) and texture coordinate stand at the
/// half-edge that leads to it, where the mesh has them. `ccw` is not resolved: faces turn as their corners do. The mesh
/// must be one of faces, and its indices those of existing values. O(corners), except for points of up to
/// FaceAdder::most_faces_of_a_point faces, where it is the square of these. Prints nothing: turns off OpenMesh's own
/// error stream.
ToOpenMesh to_openmesh(const Mesh&, bool attributes = true);

/// Positions are the vertices in their order; equal values of an attribute are one. Elements that are deleted are left
/// out. Flags (ccw, solid, ...) are a Mesh's defaults. O(corners).
Mesh from_openmesh(const OpenMeshPolygons&);

}  // namespace wrlkit
