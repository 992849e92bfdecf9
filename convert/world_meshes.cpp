#include "convert/world_meshes.h"

namespace wrlkit {

WorldMeshes::WorldMeshes(Document& document)
    : unheard_(document.diag().shared_sources()),
      silent_{unheard_, document.context().stats, document.context().resources} {
  std::string why;
  Scene& scene = document.scene();
  PassContext& context = document.context();
  if (!Pipeline::parse("lower-vrml1,expand,lower-x3d", why)->run(scene, context)) return;
  as_faces_ = Pipeline::parse("tessellate{triangles=false}", why);
  as_triangles_ = Pipeline::parse("tessellate", why);
  polygons = as_faces_->run_lazily(scene, silent_);
  triangles = as_triangles_->run_lazily(scene, context);
}

}  // namespace wrlkit
