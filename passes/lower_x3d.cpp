#include "passes/lower_x3d.h"

#include "passes/x3d/appearance.h"
#include "passes/x3d/geometry.h"
#include "passes/x3d/groups.h"
#include "passes/x3d/hanim.h"
#include "passes/x3d/materials.h"
#include "passes/x3d/vrml97.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {

Outcome lower_x3d(Scene& scene, const LowerX3dOptions& options, PassContext& ctx) {
  bool changed = false;
  for (NodeId n : all_nodes(scene)) {
    if (!options.vrml97) changed |= x3d::lower_humanoid(scene, n, ctx.diag);  // text keeps them
    if (scene.type(n).kind != NodeKind::builtin) continue;
    changed |= x3d::lower_geometry(scene, n);
    changed |= x3d::lower_appearance(scene, n, ctx.diag);
    changed |= x3d::lower_group(scene, n);
  }
  if (options.materials || options.vrml97) changed |= x3d::lower_materials(scene, ctx.diag);
  if (options.vrml97) changed |= x3d::lower_to_vrml97(scene, ctx.diag);
  return changed ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit
