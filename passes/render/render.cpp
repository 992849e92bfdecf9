#include "passes/render/render.h"

#include <algorithm>
#include <cmath>

#include "passes/render/gather.h"
#include "passes/render/inspect.h"
#include "passes/render/sampling.h"
#include "passes/render/shade.h"
#include "passes/render/wireframe.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

using namespace drawing;

/// The Viewpoint that the options ask for; none: fit.
std::optional<Placed> choose_viewpoint(const Scene& scene, const Stage& stage, const RenderOptions& options, Diagnostics& diag) {
  if (options.fit || stage.viewpoints.empty()) {
    if (!options.viewpoint.empty() && !options.fit) diag.report(Diag::viewpoint_not_found, {}, options.viewpoint);
    return {};
  }
  if (options.viewpoint.empty()) return stage.viewpoints.front();
  for (const Placed& p : stage.viewpoints)
    if (scene.name(p.node) == options.viewpoint) return p;
  for (const Placed& p : stage.viewpoints)
    if (scene.get(p.node, nodes::viewpoint::description) == options.viewpoint) return p;
  diag.report(Diag::viewpoint_not_found, {}, options.viewpoint);
  return stage.viewpoints.front();
}

Camera viewpoint_camera(const Scene& scene, const Placed& p, const Stage& stage, Lens lens, bool own_angle) {
  namespace f = nodes::viewpoint;
  if (own_angle) lens.field_of_view = scene.get(p.node, f::fieldOfView);
  return camera_in(stage.frames[p.frame] * translation(scene.get(p.node, f::position)) * rotation(scene.get(p.node, f::orientation)), lens);
}

Camera choose_camera(const Scene& scene, const Stage& stage, const RenderOptions& options, Diagnostics& diag, auto&& box) {
  Lens lens{options.width, options.height, options.field_of_view > 0 ? options.field_of_view : 0.785398};
  if (auto& l = options.look_at) return camera_at(l->eye, l->target, l->up, lens);
  if (auto p = choose_viewpoint(scene, stage, options, diag)) return viewpoint_camera(scene, *p, stage, lens, !(options.field_of_view > 0));
  return camera_on(box(), lens);
}

Sky choose_sky(const Scene& scene, const Stage& stage, const RenderOptions& options, Resources* resources, Diagnostics& diag) {
  if (options.background) return Sky(V3(*options.background));
  if (!stage.background) return Sky(V3(0));
  return Sky(scene, stage.background->node, stage.frames[stage.background->frame], resources, diag);
}

bool choose_headlight(const Scene& scene, const Stage& stage, const RenderOptions& options) {
  if (options.headlight) return *options.headlight;
  return !stage.navigation || scene.get(stage.navigation->node, nodes::navigation_info::headlight);
}

/// Billboards stand as the viewer sees them: the stage is set again for him.
void turn_billboards(const Scene& scene, const Camera& camera, Stage& stage) {
  if (!stage.billboards) return;
  Diagnostics said_already;
  Pose viewer = camera.pose();
  stage = set_stage(scene, &viewer, said_already);
}

}  // namespace

RenderOptions with_camera(const Scene& scene, const MeshSource& source, RenderOptions options, Diagnostics& diag) {
  const Stage stage = set_stage(scene, nullptr, diag);
  const Camera c = choose_camera(scene, stage, options, diag, [&] {
    MeshPool pool;
    const auto mesh_of = Gatherer(scene, source, pool).meshes_of(stage, diag);
    return bounds(stage, pool, mesh_of);
  });
  const V3 target = c.eye - c.back;
  options.look_at = LookAt{{c.eye.x, c.eye.y, c.eye.z}, {target.x, target.y, target.z}, {c.up.x, c.up.y, c.up.z}};
  options.field_of_view = 2 * std::atan(std::min(c.half_x, c.half_y));
  return options;
}

Image render(const Scene& scene, const MeshSource& source, const RenderOptions& options, Resources* resources, Diagnostics& diag) {
  Stage stage = set_stage(scene, nullptr, diag);
  MeshPool pool;
  auto mesh_of = Gatherer(scene, source, pool).meshes_of(stage, diag);
  Camera camera = choose_camera(scene, stage, options, diag, [&] { return bounds(stage, pool, mesh_of); });
  turn_billboards(scene, camera, stage);
  Raster raster{camera.width, camera.height, std::clamp(options.samples, 1, 16)};
  camera.sample_span = raster.span();

  Surfaces surfaces(scene, resources, diag);
  std::vector<std::uint32_t> surface_of;
  for (const Use& u : stage.uses) surface_of.push_back(surfaces.of(u.appearance));
  Drawing drawing{stage, pool, surfaces, mesh_of, surface_of};
  bool wireframe = options.mode == RenderOptions::Mode::wireframe;
  Tracer tracer(stage, pool, mesh_of, camera, {.cull = !wireframe}, diag);
  if (wireframe) {
    Wireframe w(drawing, tracer, camera, options.background ? V3(*options.background) : V3(1));
    return sample_picture(raster, [&](double x, double y) { return w.color(x, y); });
  }
  if (options.mode != RenderOptions::Mode::preview) {
    Inspector i(drawing, tracer, camera, options.mode, options.background ? V3(*options.background) : V3(0));
    return sample_picture(raster, [&](double x, double y) { return i.color(x, y); });
  }
  Sky sky = choose_sky(scene, stage, options, resources, diag);
  Shader shader(scene, drawing, tracer, camera, sky, choose_headlight(scene, stage, options));
  return sample_picture(raster, [&](double x, double y) { return shader.color(x, y); });
}

}  // namespace wrlkit
