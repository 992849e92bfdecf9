#include "light/render/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text/nearest_name.h"
#include "light/path_picture.h"
#include "light/render/gather.h"
#include "light/render/inspect.h"
#include "light/render/level.h"
#include "light/render/sampling.h"
#include "light/render/shade.h"
#include "light/render/widths.h"
#include "light/render/wireframe.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

using namespace drawing;

/// What may have been meant by a name that no Viewpoint has: one that is nearly it, otherwise all, as far as a line
/// goes.
std::string viewpoint_question(const Scene& scene, const Stage& stage, const std::string& name) {
  constexpr std::size_t most = 12;
  NearestName nearest(name);
  std::string all;
  std::size_t n = 0;
  for (const Placed& p : stage.viewpoints) {
    const std::string_view def = scene.name(p.node), description = scene.get(p.node, nodes::viewpoint::description);
    nearest.consider(def);
    nearest.consider(description);
    if (const auto called = description.empty() ? def : description; !called.empty() && n++ < most)
      all += fmt::format("{}'{}'", all.empty() ? "" : ", ", called);
  }
  if (!nearest.best().empty()) return nearest.question();
  if (n == 0) return "; it has none with a name";
  return "; there are " + all + (n > most ? ", ..." : "");
}

/// The file as a whole.
Span file_of(const Scene& scene) {
  return scene.main.roots.empty() ? Span{} : Span{.begin = scene.where(scene.main.roots[0]).begin};
}

/// The Viewpoint that the options ask for; none: fit.
std::optional<Placed> choose_viewpoint(const Scene& scene, const Stage& stage, const RenderOptions& options,
                                       Diagnostics& diag) {
  if (options.fit || stage.viewpoints.empty()) {
    if (!options.viewpoint.empty() && !options.fit)
      diag.report(Diag::viewpoint_not_found, file_of(scene), options.viewpoint,
                  viewpoint_question(scene, stage, options.viewpoint));
    return {};
  }
  if (options.viewpoint.empty()) return stage.viewpoints.front();
  for (const Placed& p : stage.viewpoints)
    if (scene.name(p.node) == options.viewpoint) return p;
  for (const Placed& p : stage.viewpoints)
    if (scene.get(p.node, nodes::viewpoint::description) == options.viewpoint) return p;
  diag.report(Diag::viewpoint_not_found, file_of(scene), options.viewpoint,
              viewpoint_question(scene, stage, options.viewpoint));
  return stage.viewpoints.front();
}

Camera viewpoint_camera(const Scene& scene, const Placed& p, const Stage& stage, Lens lens, bool own_angle) {
  namespace f = nodes::viewpoint;
  if (own_angle) lens.field_of_view = scene.get(p.node, f::fieldOfView);
  return camera_in(
      stage.frames[p.frame] * translation(scene.get(p.node, f::position)) * rotation(scene.get(p.node, f::orientation)),
      lens);
}

Camera choose_camera(const Scene& scene, const Stage& stage, const RenderOptions& options, Diagnostics& diag,
                     auto&& box) {
  Lens lens{options.width, options.height, options.field_of_view > 0 ? options.field_of_view : 0.785398};
  if (auto& l = options.look_at) return camera_at(l->eye, l->target, l->up, lens);
  if (auto p = choose_viewpoint(scene, stage, options, diag))
    return viewpoint_camera(scene, *p, stage, lens, !(options.field_of_view > 0));
  return camera_on(box(), lens);
}

Sky choose_sky(const Scene& scene, const Stage& stage, const RenderOptions& options, Resources* resources,
               Diagnostics& diag) {
  if (options.background) return Sky(V3(*options.background));
  if (!stage.background) return Sky(V3(0));
  return Sky(scene, stage.background->node, stage.frames[stage.background->frame], resources, diag);
}

bool choose_headlight(const Scene& scene, const Stage& stage, const RenderOptions& options) {
  if (options.headlight) return *options.headlight;
  return !stage.navigation || scene.get(stage.navigation->node, nodes::navigation_info::headlight);
}

LevelOf choose_levels(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  if (!options.level) return levels_by_distance(scene, camera.eye);
  return [level = *options.level](NodeId, const Affine&) { return level; };
}

/// The stage as the viewer sees it: Billboards turn to him, and LODs show their levels.
Stage seen_stage(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  Diagnostics said_already;
  return set_stage(scene, said_already, {.viewer = camera.pose(), .level_of = choose_levels(scene, camera, options)});
}

Box bounds_of(const Scene& scene, const Stage& stage, const MeshSource& source, Diagnostics& diag) {
  MeshPool pool;
  const auto mesh_of = Gatherer(scene, source, pool).meshes_of(stage, diag);
  return bounds(stage, pool, mesh_of);
}

/// Pictures of lightmaps are grey all over where there is none.
void report_no_lightmap(const Drawing& d, RenderOptions::Mode mode, Diagnostics& diag) {
  using Mode = RenderOptions::Mode;
  if (mode != Mode::lightmap && mode != Mode::checker && mode != Mode::density) return;
  for (std::size_t u = 0; u < d.surface_of.size(); ++u)
    if (d.surfaces[d.surface_of[u]].baked && d.meshes[d.mesh_of[u]].lightcoords != PooledMesh::absent) return;
  diag.report(
      Diag::no_lightmap, {},
      "all is grey; light that is one picture with colour (VRML; glTF with --lightmap-as base-color) is seen in "
      "the other modes");
}

RenderOptions seen_by(const Camera& c, RenderOptions options) {
  options.look_at = LookAt{c.eye, c.eye - c.back, c.up};
  options.field_of_view = 2 * std::atan(std::min(c.half_x, c.half_y));
  return options;
}

/// The box with room for what is in it however it is turned around the vertical through its middle.
Box room_to_turn(const Box& box) {
  if (box.empty()) return box;
  const V3 size = box.size(), middle = box.centre();
  const double radius = 0.5 * std::hypot(size.x, size.z);
  Box out;
  out.add({middle.x - radius, box.low[1], middle.z - radius});
  out.add({middle.x + radius, box.high[1], middle.z + radius});
  return out;
}

}  // namespace

RenderOptions with_camera(const Scene& scene, const MeshSource& source, const RenderOptions& options,
                          Diagnostics& diag) {
  const Stage stage = set_stage(scene, diag);
  return seen_by(choose_camera(scene, stage, options, diag, [&] { return bounds_of(scene, stage, source, diag); }),
                 options);
}

std::vector<RenderOptions> turntable(const Scene& scene, const MeshSource& source, RenderOptions options, int n,
                                     Diagnostics& diag) {
  const Stage stage = set_stage(scene, diag);
  const Box box = bounds_of(scene, stage, source, diag);
  if (options.viewpoint.empty()) options.fit = true;
  const Camera first = choose_camera(scene, stage, options, diag, [&] { return room_to_turn(box); });
  const V3 axis = box.empty() ? Vec3{} : box.centre();
  std::vector<RenderOptions> out;
  for (int i = 0; i < n; ++i) {
    const Affine turn = rotation({0, 1, 0, 2 * std::numbers::pi * i / n});
    Camera c = first;
    c.eye = axis + turn.vector(first.eye - axis);
    c.back = turn.vector(first.back);
    c.up = turn.vector(first.up);
    out.push_back(seen_by(c, options));
  }
  return out;
}

Image render(const Scene& scene, const MeshSource& source, const RenderOptions& options, Resources* resources,
             Diagnostics& diag) {
  Stage stage = set_stage(scene, diag);
  const auto box_of_all = [&] { return bounds_of(scene, stage, source, diag); };
  if (options.mode == RenderOptions::Mode::path) {
    const Camera seen_from = choose_camera(scene, stage, options, diag, box_of_all);
    light::PathOptions how{.samples = std::clamp(options.samples, 1, 64),
                           .lamps = options.lamps,
                           .exposure = options.exposure,
                           .level_of = choose_levels(scene, seen_from, options),
                           .done = options.done};
    if (options.background) how.background = light::linear(V3(*options.background));
    return light::path_picture(scene, source, seen_from, how, resources, diag);
  }
  MeshPool pool;
  std::vector<std::uint32_t> mesh_of;
  const bool shows_all = options.level == 0;  // what the camera is to see is what is drawn
  if (shows_all) mesh_of = Gatherer(scene, source, pool).meshes_of(stage, diag);
  Camera camera = choose_camera(scene, stage, options, diag,
                                [&] { return shows_all ? bounds(stage, pool, mesh_of) : box_of_all(); });
  if (stage.billboards || !shows_all) stage = seen_stage(scene, camera, options);
  if (!shows_all) mesh_of = Gatherer(scene, source, pool).meshes_of(stage, diag);
  Raster raster{camera.width, camera.height, std::clamp(options.samples, 1, 16)};
  camera.sample_span = raster.span();

  Surfaces surfaces(scene, resources, diag);
  std::vector<std::uint32_t> surface_of;
  for (const Use& u : stage.uses) surface_of.push_back(surfaces.of(u.appearance));
  Drawing drawing{stage, pool, surfaces, mesh_of, surface_of};
  bool wireframe = options.mode == RenderOptions::Mode::wireframe;
  const auto widths = widths_of(scene, stage, pool, mesh_of);
  Tracer tracer(stage, pool, mesh_of, camera, {.cull = !wireframe, .widths = widths}, diag);
  if (wireframe) {
    Wireframe w(drawing, tracer, camera, options.background ? V3(*options.background) : V3(1));
    return sample_picture(raster, [&](double x, double y) { return w.color(x, y); });
  }
  if (options.mode != RenderOptions::Mode::preview) {
    report_no_lightmap(drawing, options.mode, diag);
    Inspector i(drawing, tracer, camera, options.mode, options.background ? V3(*options.background) : V3(0));
    return sample_picture(raster, [&](double x, double y) { return i.color(x, y); });
  }
  Sky sky = choose_sky(scene, stage, options, resources, diag);
  Shader shader(scene, drawing, tracer, camera, sky, choose_headlight(scene, stage, options));
  return sample_picture(raster, [&](double x, double y) { return shader.color(x, y); });
}

}  // namespace wrlkit
