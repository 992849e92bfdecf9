// Surfaces for tools of OpenMesh that need a manifold.
#pragma once
#include <optional>
#include <string_view>

#include "geometry/mesh_job.h"

namespace wrlkit {

struct ToOpenMesh;

/// Whether a pass can have OpenMesh work on the mesh of a job: faces, whose points belong to it alone. When this build
/// has no OpenMesh, that is reported.
bool is_for_openmesh(MeshJob& job, std::string_view pass);
/// Positions and faces without attributes; nothing, and a message, when they are not a manifold.
std::optional<ToOpenMesh> manifold_of(MeshJob& job, std::string_view pass);

/// Normals are dropped when the surface is another one.
void drop_normals(MeshJob& job, std::string_view pass);

}  // namespace wrlkit
