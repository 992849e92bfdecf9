// Every geometry node as a mesh.
#pragma once
#include "base/option_range.h"
#include "geometry/mesh_job.h"

namespace wrlkit {

/// How finely curved shapes are cut, and what is made in addition to the faces.
///
/// A circle of radius r gets the fewest segments whose sagitta (the distance from the middle of a chord to the arc)
/// stays within the tolerance, rounded up to a multiple of four so that the extreme points on both axes, and with them
/// the bounds, are exact; at least 8, at most 256. A Sphere has half as many from pole to pole.
///
/// With tolerance 0 the sagitta is 0.005 * sqrt(r): half a per cent of the geometric mean of the radius and one metre.
/// The segments then grow with the fourth root of the radius, between 8 and 64, so that a bolt of 5 mm gets 12, a pipe
/// of 0.1 m 20, a unit Cylinder 32, a tank of 10 m 56; in a scene written in millimetres they are finer, but never
/// beyond 64.
struct Tessellation {
  double tolerance = 0;  // metres of the local frame; 0: automatic
  int segments = 0;      // around a circle, in [3, 1024], an even number for Sphere; 0: from the tolerance
  bool triangles = true;
  bool texcoords = false;  // for a job that is `textured`

  /// For passes that make meshes of what they change: how finely, so that their options show it.
  void fineness_fields(auto&& f) {
    f("tolerance", tolerance, "maximum distance between a curved surface and its faces; 0: set by its size",
      a_length());
    f("segments", segments, "faces around Cone, Cylinder and Sphere; 0: set by tolerance", between(0, 4096));
  }
  void fields(auto&& f) {
    fineness_fields(f);
    f("triangles", triangles, "cut all faces into triangles");
    f("texcoords", texcoords, "make the default texture coordinates where a texture needs them and the file has none");
  }
};

/// Makes job.mesh of any geometry node: reads it (geometry.h) unless it is there already, makes the faces of Box,
/// Cone, Cylinder, Sphere, Extrusion, ElevationGrid and Text, and cuts them into triangles (triangulation.h). Shapes
/// without a surface give a mesh of kind `faces` without faces, and degenerate-geometry. Nodes that are not geometry
/// stay kind `none`.
///
/// Box, Cone, Cylinder and Sphere come with exact normals and the texture coordinates of the standard, and
/// mesh.primitive set; Extrusion and ElevationGrid with their texture coordinates, their normals are left to the
/// `normals` pass.
///
/// True when the mesh changed.
bool make_mesh(MeshJob& job, const Tessellation& options);

/// Texture coordinates for a mesh without any, from its bounding box (ISO/IEC 14772-1, 6.23): S runs over the longest
/// side from 0 to 1, T over the second longest in the same scale; of equal sides X comes before Y before Z. The box is
/// that of the positions in use. Nothing happens to a mesh that has texture coordinates, or no faces.
void default_texcoords(Mesh& mesh);

}  // namespace wrlkit
