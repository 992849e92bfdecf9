#include "passes/normals/normals.h"

#include "geometry/normals.h"

namespace wrlkit {

Outcome normals(MeshJob& job, const NormalsOptions& options) {
  Mesh& mesh = job.mesh;
  const bool given = mesh.normal.present() && (mesh.primitive || !options.recompute);
  if (mesh.kind != Mesh::Kind::faces || mesh.corners.empty() || given) return Outcome::unchanged;
  make_normals(mesh, job.scratch, options.crease_angle >= 0 ? options.crease_angle : mesh.crease_angle);
  return Outcome::changed;
}

}  // namespace wrlkit
