#include "passes/lightmap/lightmap.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <unordered_map>

#include <fmt/format.h>

#include "base/image/image.h"
#include "base/math/digits.h"
#include "geometry/geometry.h"
#include "geometry/simplify/surfaces.h"
#include "light/render/stage.h"
#include "light/world.h"
#include "passes/lightmap/bake.h"
#include "passes/lightmap/bake_progress.h"
#include "passes/lightmap/checkpoint.h"
#include "passes/lightmap/driven_lights.h"
#include "passes/lightmap/finest_light.h"
#include "passes/lightmap/from_patches.h"
#include "passes/lightmap/info_line.h"
#include "passes/lightmap/layout.h"
#include "passes/lightmap/levels.h"
#include "passes/lightmap/own_shapes.h"
#include "passes/lightmap/parts.h"
#include "passes/lightmap/sizes.h"
#include "passes/lightmap/store.h"
#include "passes/lightmap/time_budget.h"
#include "passes/lightmap/unlit_nodes.h"
#include "passes/lightmap/unlit_shapes.h"
#include "passes/normals/normals.h"
#include "scenegraph/driven.h"
#include "scenegraph/looks/material_node.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

using namespace bake;

/// What a quality stands for.
struct Work {
  int side, samples, rays;  // of a page; points a texel; rays a point
};
Work work_of(BakeQuality quality) {
  constexpr Work works[] = {{512, 4, 4}, {1024, 4, 16}, {4096, 4, 64}};
  return works[static_cast<std::size_t>(quality)];
}
constexpr int side_for_density = 4096, smallest_side = 64;
constexpr double share_of_first_view = 0.75;  // of the time: each further one has a fourth of the texels

/// What is seen from further away needs half the texels, down to a hundredth of the first.
LayoutOptions layout_options(const LightmapOptions& o, std::size_t depth) {
  const int usual = o.density > 0 ? side_for_density : work_of(o.quality).side;
  const int side = o.max_size > 0 ? o.max_size : usual, halvings = static_cast<int>(std::min<std::size_t>(depth, 7));
  if (o.density > 0) return {.density = std::ldexp(o.density, -halvings), .side = side, .mips = o.mips};
  return {.side = std::max(side >> halvings, std::min(side, smallest_side)), .mips = o.mips};
}

light::LightOptions light_options(const LightmapOptions& o, const Levels& levels) {
  light::LightOptions out;
  out.level_of = levels.level_of();
  out.emission = o.emission;
  out.lamps = o.lamps;
  set_sky(out, o.sky);
  return out;
}

/// Each view has a file of its own: those that are done are there until all are.
std::string checkpoint_of(const LightmapOptions& o, std::size_t view) {
  const std::string& path = o.checkpoint.path;
  return path.empty() || !view ? path : path + "." + std::to_string(view + 1);
}

BakeOptions bake_options(const LightmapOptions& o, std::size_t view, std::string title) {
  const Work work = work_of(o.quality);
  BakeOptions out;
  out.title = std::move(title);
  out.samples = work.samples;
  out.rays = out.integrator.rays = o.rays > 0 && !(o.error > 0) ? std::max(2, o.rays) : work.rays;
  if (o.rays > 0) out.most_rays = o.rays;
  out.integrator.seed = static_cast<std::uint64_t>(o.seed);
  out.error = o.error;
  if (o.error > 0) out.integrator.rays = std::max(work_of(BakeQuality::normal).rays, work.rays);
  out.directional = o.directional;
  out.denoise = o.denoise;
  out.checkpoint = checkpoint_of(o, view);
  return out;
}

/// Geometry as light meets it: with normals, for shading.
class Meshes {
 public:
  Meshes(const Scene& scene, const Tessellation& faces, PassContext& ctx)
      : scene_(scene), faces_(faces), ctx_(ctx), textured_(textured_geometry(scene)) {}

  const Mesh& operator()(NodeId geometry) {
    MeshJob job{scene_, geometry, mesh_, scratch_, ctx_, textured_[geometry.value] != 0};
    mesh_.clear();
    make_mesh(job, faces_);
    normals(job, {});
    return mesh_;
  }

 private:
  const Scene& scene_;
  const Tessellation& faces_;
  PassContext& ctx_;
  std::vector<char> textured_;
  Mesh mesh_;
  MeshScratch scratch_;
};

/// Of the names on the way to a Shape the nearest one that fits counts.
double density_of(const NamedDensities& densities, const Scene& scene, const drawing::Stage& stage, std::uint32_t use) {
  for (std::uint32_t n = stage.uses[use].name; n; n = stage.names[n].parent)
    if (const double factor = densities.of(scene.name(stage.names[n].node)); factor != 0) return factor;
  return 1;
}

/// Of the nearest node on the way to its first Shape that has one; else the type of the geometry.
std::string_view name_of(const Part& p, const Scene& scene, const drawing::Stage& stage) {
  for (std::uint32_t n = stage.uses[p.uses[0]].name; n; n = stage.names[n].parent)
    if (const auto name = scene.name(stage.names[n].node); !name.empty()) return name;
  return scene.type(p.geometry).name;
}

Outcome take_patches(Scene& scene, const light::LightWorld& world, const LightmapOptions& options, PassContext& ctx) {
  const auto patches = ctx.resources->patches(options.patches, ctx.diag);
  if (!patches) return Outcome::failed;
  return light_from_patches(scene, world, *patches,
                            {options.smooth, std::string(name_of(options.format)), options.faces}, ctx)
             ? Outcome::changed
             : Outcome::unchanged;
}

/// What nobody sees from within is sealed; what has light already stays as it is; each density and size is a part of
/// its own.
void prepare(std::vector<Part>& parts, const Scene& scene, light::LightWorld& world, const Levels& levels,
             const LightmapOptions& options, Diagnostics& diag) {
  const auto& uses = world.stage().uses;
  for (Part& p : parts) {
    for (std::uint32_t u : p.uses)
      if (p.sealed) world.seal(u, p.inside_out);
    std::erase_if(p.uses, [&](std::uint32_t u) { return levels.is_lit(uses[u].shape); });
  }
  std::erase_if(parts, [](const Part& p) { return p.uses.empty(); });
  for (const Part& p : parts)
    if (p.faces_in) diag.report(Diag::inside_out, scene.where(p.geometry), name_of(p, scene, world.stage()));
  split_by_size(parts, world.stage(),
                [&](std::uint32_t u) { return density_of(options.densities, scene, world.stage(), u); });
}

/// Where they are a part of what is seen, not only bolts that something hides.
void report_dark(const std::vector<BakedPage>& pages, const std::vector<Part>& parts, const Scene& scene,
                 const drawing::Stage& stage, Diagnostics& diag) {
  constexpr std::size_t some = 100;  // one in that many texels
  std::size_t n_texels = 0, n_dark_texels = 0, n_dark = 0, n_shapes = 0;
  std::uint32_t first = 0xffffffff;
  for (const BakedPage& page : pages) {
    n_texels += page.n_texels;
    n_dark += page.dark.size();
    for (const DarkUse& d : page.dark) {
      n_dark_texels += d.n_texels;
      first = std::min(first, d.use);
    }
  }
  for (const Part& p : parts) n_shapes += p.uses.size();
  if (n_dark && some * n_dark_texels >= n_texels)
    diag.report(Diag::dark_shapes, scene.where(stage.uses[first].shape), n_dark, n_shapes);
}

/// The factor for all views; by exposure=auto the one that the first levels of detail want.
class ViewExposure {
 public:
  explicit ViewExposure(const Exposure& wanted) : wanted_(wanted), factor_(wanted.factor) {}

  double of(const std::vector<BakedPage>& pages, PassContext& ctx) {
    if (std::exchange(is_known_, true)) return factor_;
    light::LightMeter meter;
    for (const BakedPage& p : pages) meter.add(p.meter);
    if (!wanted_.automatic) {
      report_clipped(meter, ctx);
      return factor_;
    }
    factor_ = meter.factor(light_of_middle_grey);
    const std::string said = Exposure{.factor = factor_}.print();
    ctx.diag.report(Diag::light_exposure, {}, said, "exposure=" + said);
    ctx.stats["lightmap.exposure-thousandths"] += static_cast<std::uint64_t>(std::lround(1000 * factor_));
    return factor_;
  }
  void keep(Scene& scene) const {
    if (factor_ != 1) keep_in_info(scene, "exposure", Exposure{.factor = factor_}.print());
  }

 private:
  static constexpr double light_of_middle_grey = 0.36;  // on what reflects a half of it
  static constexpr double light_of_white = 1.25;        // on what reflects four fifths of it
  static constexpr double much = 1.0 / 3;               // of the texels

  void report_clipped(const light::LightMeter& meter, PassContext& ctx) const {
    const double share = meter.share_above(light_of_white / factor_);
    if (share > much) ctx.diag.report(Diag::light_clipped, {}, std::lround(100 * share));
  }

  Exposure wanted_;
  double factor_;
  bool is_known_ = false;
};

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What the views of a world share.
struct Views {
  LightmapOptions options;
  Clock::time_point start;
  std::size_t n_views;
  Levels levels;
  FinestLight finest;
  UnlitShapes unlit;
  ViewExposure exposure;
  BakeProgress progress;
};

/// The options with what the time allows, found by small bakes of these parts.
LightmapOptions within_budget(const LightmapOptions& o, double seconds, const std::vector<Part>& parts,
                              const light::LightWorld& world, const PassContext& ctx) {
  const bool any_scale = !(o.density > 0) && o.max_size == 0;
  const auto sized = [&](const bake::BakeSize& size) {
    LightmapOptions out = o;
    out.rays = size.rays;
    if (any_scale) out.max_size = static_cast<int>(std::lround(size.scale * side_for_density));
    return out;
  };
  const auto trial = [&](const bake::BakeSize& size) {
    const auto start = Clock::now();
    LightmapOptions small = sized(size);
    small.error = 0;
    LayoutOptions pages = layout_options(small, 0);
    if (o.density > 0) pages.density *= size.scale;
    if (!any_scale) pages.side = std::max(smallest_side, static_cast<int>(std::lround(size.scale * pages.side)));
    Diagnostics unheard;
    Statistics uncounted;
    PassContext alone(unheard, uncounted, ctx.resources, nullptr, ctx.stop);
    BakeOptions how = bake_options(small, 0, "");
    how.checkpoint.clear();
    bake::bake(parts, Layout(parts, pages), world, how, alone);
    return seconds_since(start);
  };
  return sized(bake::size_for_time(seconds, any_scale, trial));
}

/// The options that give the same light again.
void keep_size(Scene& scene, const LightmapOptions& o, Statistics& stats) {
  keep_in_info(scene, "budget", "max-size=" + std::to_string(o.max_size) + ",rays=" + std::to_string(o.rays));
  stats["lightmap.page-side"] += static_cast<std::uint64_t>(o.max_size);
  stats["lightmap.rays-a-point"] += static_cast<std::uint64_t>(o.rays);
}

/// Lights what the view shows.
Outcome bake_view(Scene& scene, Views& views, PassContext& ctx) {
  auto& [options, start, n_views, levels, finest, unlit, exposure, progress] = views;
  const std::string title = levels.view() ? "lightmap, view " + std::to_string(levels.view() + 1) : "lightmap";
  auto say = [&](const char* what) {
    if (ctx.monitor) ctx.monitor->begin(title + what, 0, "");
  };
  progress.begin_view(levels.view());
  say(": surfaces");
  levels.own_what_is_lit();
  Meshes meshes(scene, options.faces, ctx);
  light::LightWorld world(scene, std::ref(meshes), ctx.resources, light_options(options, levels), ctx.diag);
  if (!options.patches.empty()) {
    if (options.unlit == UnlitSurfaces::bake)
      unlit.report_kept(world, "patches light only Shapes with a Material", ctx.diag);
    return take_patches(scene, world, options, ctx);
  }
  if (!levels.depth()) levels.find_shades(world);
  unlit.look_at(world, ctx.diag);
  auto parts = find_parts(scene, world, unlit, options.faces, ctx);
  prepare(parts, scene, world, levels, options, ctx.diag);
  if (parts.empty()) return Outcome::unchanged;
  if (!world.has_sky_of_its_own() && !levels.depth()) ctx.diag.report(Diag::no_light, {});
  say(": charts");
  unfold_parts(parts, world.stage());
  if (options.budget.seconds > 0 && !levels.view()) {
    say(": how much there is time for");
    const double of_first = n_views > 1 ? share_of_first_view : 1;
    options = within_budget(options, of_first * (options.budget.seconds - seconds_since(start)), parts, world, ctx);
  }
  const LayoutOptions wanted = layout_options(options, levels.depth());
  const Layout layout(parts, wanted);
  if (const auto coarse = layout.coarse(); coarse.n_shapes)
    ctx.diag.report(Diag::density_limit, {}, wanted.density, coarse.n_shapes, coarse.least * wanted.density);
  BakeOptions how = bake_options(options, levels.view(), title);
  if (levels.view() && !options.directional) how.finest = &finest;
  auto pages = bake::bake(parts, layout, world, how, ctx);
  report_dark(pages, parts, scene, world.stage(), ctx.diag);
  say(": pictures");
  unlit.give_material(scene, parts, world.stage());
  store(scene, parts, layout, world.stage(), pages,
        {std::string(name_of(options.format)), options.exr, exposure.of(pages, ctx)}, ctx);
  for (const Part& p : parts) {
    for (std::uint32_t u : p.uses) levels.add(world.stage().uses[u].shape);
    ctx.stats["lightmap.shapes"] += p.uses.size();
    ctx.stats["lightmap.charts"] += p.charts.size() * p.uses.size();
  }
  ctx.stats["lightmap.pages"] += pages.size();
  if (!levels.view() && !options.directional) finest.keep(parts, layout, world.stage(), std::move(pages));
  return Outcome::changed;
}

void report_not_lit(const Scene& scene, Diagnostics& diag) {
  if (const auto n = closed_nodes(scene))
    diag.report(Diag::not_lit, {},
                fmt::format("{} {} could not be read", n,
                            n == 1 ? "Inline or prototype instance that" : "Inlines or prototype instances that"));
  std::vector<char> is_shown(scene.node_count());
  for (NodeId n : reachable(scene, scene.main)) is_shown[n.value] = 1;
  const auto left = [&](NodeId shape, const char* why) {
    const auto material = material_of(scene, scene.get(shape, nodes::shape::appearance));
    if (material && material->kind != MaterialNode::Kind::unlit && is_shown[shape.value])
      diag.report(Diag::not_lit, scene.where(shape), why);
  };
  const auto driven = driven_geometry(scene);
  for (const auto& s : surfaces_of(scene, left, BelowLod::take, OfText::take))
    if (scene.is(s.geometry, nodes::Text) && driven[s.geometry.value])
      for (NodeId shape : s.shapes) left(shape, "a Text that events may change");
}

Outcome bake_into(Scene& scene, const LightmapOptions& options, PassContext& ctx) {
  const auto start = Clock::now();
  report_not_lit(scene, ctx.diag);
  report_driven_lights(scene, ctx.diag);
  if (const auto n = foreign_surfaces(scene)) ctx.diag.report(Diag::not_lowered, {}, n);
  const auto n_copies = own_shapes(scene, ctx.diag, options.patches.empty() ? OfLod::all : OfLod::first);
  const std::size_t n_views = ctx.monitor || options.budget.seconds > 0 ? Levels::count(scene) : 1;
  Views views{options,
              start,
              n_views,
              Levels(scene),
              FinestLight(scene),
              UnlitShapes(scene, options.unlit == UnlitSurfaces::bake),
              ViewExposure(options.exposure),
              BakeProgress(ctx.monitor, n_views, !(options.error > 0))};
  PassContext watched = ctx;
  watched.monitor = views.progress.monitor();
  const Levels& levels = views.levels;
  Outcome all = n_copies ? Outcome::changed : Outcome::unchanged;
  while (all != Outcome::failed && views.levels.next()) {
    if (const Outcome one = bake_view(scene, views, watched); one != Outcome::unchanged) all = one;
    if (!options.patches.empty()) return all;
  }
  for (std::size_t view = 0; !options.checkpoint.path.empty() && view <= levels.view(); ++view)
    bake::Checkpoint::remove(checkpoint_of(options, view));
  if (all == Outcome::changed) views.exposure.keep(scene);
  if (options.budget.seconds > 0 && views.options.rays > 0) keep_size(scene, views.options, ctx.stats);
  if (levels.n_unseen())
    ctx.diag.report(Diag::expansion_limit, {}, Levels::most, "levels of detail one behind the other");
  return all;
}

bool fits(std::string_view name, std::string_view pattern) {
  return pattern.back() == '*' ? name.starts_with(pattern.substr(0, pattern.size() - 1)) : name == pattern;
}

void report_unused(const NamedDensities& densities, const Scene& scene, Diagnostics& diag) {
  const auto nodes = reachable(scene, scene.main);
  for (const auto& one : densities.all)
    if (std::ranges::none_of(nodes, [&](NodeId n) { return fits(scene.name(n), one.first); }))
      diag.report(Diag::no_name_matches, {}, "densities of lightmap", one.first);
}

}  // namespace

bool NamedDensities::read(std::string_view text) {
  all.clear();
  while (!text.empty()) {
    const std::string_view one = text.substr(0, text.find(':'));
    const auto sign = one.rfind('=');
    if (sign == std::string_view::npos || sign == 0) return false;
    double factor = 0;
    if (!read_number(one.substr(sign + 1), factor) || !(factor >= 1e-3 && factor <= 1e3)) return false;
    all.emplace_back(one.substr(0, sign), factor);
    text.remove_prefix(std::min(text.size(), one.size() + 1));
  }
  return true;
}

std::string NamedDensities::print() const {
  std::string text;
  for (const auto& [name, factor] : all) {
    char number[32];
    std::snprintf(number, sizeof number, "%.9g", factor);
    text += (text.empty() ? "" : ":") + name + "=" + number;
  }
  return text;
}

double NamedDensities::of(std::string_view name) const {
  const auto fitting = std::ranges::find_if(all, [&](const auto& one) { return fits(name, one.first); });
  return fitting == all.end() ? 0 : fitting->second;
}

Outcome lightmap(Scene& scene, const LightmapOptions& options, PassContext& ctx) {
  if (!ctx.resources) return Outcome::unchanged;
  if (!options.densities.all.empty()) report_unused(options.densities, scene, ctx.diag);
  return bake_into(scene, options, ctx);
}

}  // namespace wrlkit
