#include "tools/world_meshes.h"

namespace wrlkit {

WorldMeshes::WorldMeshes(Session& s)
    : unheard_(s.diag().shared_sources()), silent_{unheard_, s.context().stats, s.context().resources} {
  std::string why;
  Scene& scene = s.world().scene;
  if (!Pipeline::parse("lower-vrml1,expand,lower-x3d", why)->run(scene, s.context())) return;
  as_faces_ = Pipeline::parse("tessellate{triangles=false}", why);
  as_triangles_ = Pipeline::parse("tessellate", why);
  polygons = as_faces_->run_lazily(scene, silent_);
  triangles = as_triangles_->run_lazily(scene, s.context());
}

}  // namespace wrlkit
