#include "passes/smooth/smooth.h"

#include <algorithm>

#include "passes/analysis/manifold.h"

#ifdef WRLKIT_OPENMESH

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Smoother/JacobiLaplaceSmootherT.hh>

#include "geometry/openmesh/openmesh.h"

namespace wrlkit {

Outcome smooth(MeshJob& job, const SmoothOptions& options) {
  if (!is_for_openmesh(job, "smooth")) return Outcome::unchanged;
  auto surface = manifold_of(job, "smooth");
  if (!surface) return Outcome::unchanged;
  using Smoother = OpenMesh::Smoother::JacobiLaplaceSmootherT<OpenMeshPolygons>;
  Smoother smoother(surface->mesh);
  smoother.initialize(Smoother::Tangential_and_Normal, Smoother::C0);
  smoother.smooth(static_cast<unsigned>(options.iterations));
  auto faces = from_openmesh(surface->mesh);
  // Where all points lie on borders nothing moves.
  if (std::ranges::equal(faces.positions.span(), job.mesh.positions.span()) && faces.corners == job.mesh.corners &&
      !job.mesh.primitive && !job.mesh.normal.present())
    return Outcome::unchanged;
  job.mesh.positions = std::move(faces.positions);
  job.mesh.corners = std::move(faces.corners);
  job.mesh.primitive = false;
  drop_normals(job, "smooth");
  return Outcome::changed;
}

}  // namespace wrlkit

#else

namespace wrlkit {

Outcome smooth(MeshJob& job, const SmoothOptions&) {
  is_for_openmesh(job, "smooth");
  return Outcome::unchanged;
}

}  // namespace wrlkit

#endif
