#include "passes/lower_x3d/lower_x3d.h"

#include "passes/lower_x3d/appearance.h"
#include "passes/lower_x3d/browser_nodes.h"
#include "passes/lower_x3d/clip_planes.h"
#include "passes/lower_x3d/generated_texcoords.h"
#include "passes/lower_x3d/geo.h"
#include "passes/lower_x3d/geometry.h"
#include "passes/lower_x3d/groups.h"
#include "passes/lower_x3d/interpolators.h"
#include "passes/lower_x3d/materials.h"
#include "passes/lower_x3d/multi_texture.h"
#include "passes/lower_x3d/nurbs_geometry.h"
#include "passes/lower_x3d/particles.h"
#include "passes/lower_x3d/plant_shapes.h"
#include "passes/lower_x3d/product.h"
#include "passes/lower_x3d/surface_interpolators.h"
#include "passes/lower_x3d/texcoords_3d.h"
#include "passes/lower_x3d/two_sides.h"
#include "passes/lower_x3d/vrml97.h"
#include "scenegraph/any_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// Curves last: surfaces and interpolators are made with them.
bool lower_curves(Scene& scene, const LowerX3dOptions& options, Diagnostics& diag) {
  const auto is_nurbs = [&](NodeId n) {
    return scene.is(n, nodes::CoordinateDouble) || scene.type(n).name.starts_with("Nurbs");
  };
  if (!any_node(scene, is_nurbs)) return false;
  bool changed = false;
  for (bool last : {false, true})
    for (NodeId n : all_nodes(scene)) {
      const auto& type = scene.type(n);
      const bool curve = scene.is(n, nodes::NurbsCurve) || scene.is(n, nodes::CoordinateDouble);
      if (type.kind != NodeKind::builtin || curve != last) continue;
      if (!x3d::lower_nurbs(scene, n, options.tolerance, diag) &&
          !x3d::lower_nurbs_interpolator(scene, n, options.tolerance, diag))
        continue;
      if (options.vrml97 && type.name != "CoordinateDouble")
        diag.report(Diag::no_vrml97_curve, scene.where(n), type.name);
      changed = true;
    }
  return changed;
}

/// Before materials become those of one side.
bool split_sides(Scene& scene) {
  namespace back = nodes::appearance;
  const auto has_back = [&](NodeId n) {
    return scene.is(n, nodes::TwoSidedMaterial) || (scene.is(n, nodes::Appearance) && scene.get(n, back::backMaterial));
  };
  if (!any_node(scene, has_back)) return false;
  bool changed = false;
  const auto driven = x3d::routed_nodes(scene);
  for (NodeId n : all_nodes(scene)) changed |= x3d::split_sides(scene, n, driven);
  return changed;
}

}  // namespace

Outcome lower_x3d(Scene& scene, const LowerX3dOptions& options, PassContext& ctx) {
  bool changed = x3d::place_on_earth(scene, ctx.diag);
  changed |= lower_curves(scene, options, ctx.diag);
  changed |= x3d::lower_interpolators(scene, options.vrml97, ctx.diag);
  changed |= x3d::lower_surface_interpolators(scene, options.tolerance, ctx.diag);
  changed |= x3d::lower_plant_shapes(scene, ctx.diag);
  changed |= x3d::lower_particles(scene, ctx);
  changed |= x3d::combine_multi_textures(scene, ctx);
  changed |= split_sides(scene);
  for (NodeId n : all_nodes(scene)) {
    changed |= x3d::lower_browser_node(scene, n);
    if (scene.type(n).kind != NodeKind::builtin) continue;
    changed |= x3d::lower_geometry(scene, n);
    changed |= x3d::lower_appearance(scene, n, ctx.diag);
    changed |= x3d::lower_group(scene, n, ctx.diag);
  }
  changed |= x3d::make_generated_texcoords(scene, ctx);
  changed |= x3d::flatten_texcoords(scene, ctx);
  changed |= x3d::cut_by_clip_planes(scene, ctx);
  const bool all = options.vrml97 && !options.defer_colors;
  if (all) changed |= x3d::lower_products(scene, ctx);
  if (options.materials || all) changed |= x3d::lower_materials(scene, all, ctx.diag);
  if (all) changed |= x3d::lower_to_vrml97(scene, ctx.diag);
  return changed ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit
