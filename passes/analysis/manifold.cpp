#include "passes/analysis/manifold.h"

#include <string>

#ifdef WRLKIT_OPENMESH
#include "geometry/openmesh/openmesh.h"
#endif

namespace wrlkit {

bool is_for_openmesh(MeshJob& job, std::string_view pass) {
  if (job.driven || job.mesh.kind != Mesh::Kind::faces || job.mesh.corners.empty()) return false;
#ifdef WRLKIT_OPENMESH
  static_cast<void>(pass);
  return true;
#else
  job.ctx.diag.report(Diag::without_package, job.scene.where(job.geometry), pass, "OpenMesh");
  return false;
#endif
}

void drop_normals(MeshJob& job, std::string_view pass) {
  if (!job.mesh.normal.present()) return;
  job.mesh.normal.clear();
  job.ctx.stats[std::string(pass) + ".dropped-normals"] += 1;
}

#ifdef WRLKIT_OPENMESH

std::optional<ToOpenMesh> manifold_of(MeshJob& job, std::string_view pass) {
  ToOpenMesh surface = to_openmesh(job.mesh, false);
  std::size_t n_touching = 0;
  for (auto v : surface.mesh.vertices()) n_touching += !surface.mesh.is_manifold(v);
  if (surface.faults.count() + n_touching == 0) return surface;
  job.ctx.diag.report(Diag::not_manifold, job.scene.where(job.geometry), pass, surface.faults.count(), n_touching);
  return std::nullopt;
}

#endif

}  // namespace wrlkit
