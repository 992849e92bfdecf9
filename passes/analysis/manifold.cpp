#include "passes/analysis/manifold.h"

#include <string>

#ifdef WRLKIT_OPENMESH
#include "geometry/openmesh/openmesh.h"
#endif

namespace wrlkit {
namespace {

[[maybe_unused]] void report(MeshJob& job, std::string_view pass, const std::string& why) {
  job.ctx.diag.report(Diag::verify, job.scene.where(job.geometry),
                      std::string(pass) + " leaves this surface as it is: " + why);
}

}  // namespace

bool is_for_openmesh(MeshJob& job, std::string_view pass) {
  if (job.driven || job.mesh.kind != Mesh::Kind::faces || job.mesh.corners.empty()) return false;
#ifdef WRLKIT_OPENMESH
  static_cast<void>(pass);
  return true;
#else
  report(job, pass, "this wrlkit was built without OpenMesh");
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
  report(job, pass,
         "it is not a manifold: " + std::to_string(surface.faults.count()) +
             " faces at edges or points that have all their faces, " + std::to_string(n_touching) +
             " points where faces only touch");
  return std::nullopt;
}

#endif

}  // namespace wrlkit
