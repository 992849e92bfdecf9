#include "passes/lod/lod.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/math/digits.h"
#include "base/parallel.h"
#include "base/silent_task.h"
#include "geometry/simplify/group_lods.h"
#include "geometry/simplify/lod_nodes.h"
#include "geometry/simplify/shared_borders.h"
#include "geometry/simplify/world_levels.h"
#include "passes/analysis/world_scales.h"
#include "passes/lod/cell_lods.h"
#include "passes/pipeline/length_option.h"
#include "scenegraph/nodes.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

/// A surface on its way: read, simplified, stored.
struct Part {
  Mesh mesh;
  std::vector<MeshLevel> levels;
};

class Lod {
 public:
  Lod(Scene& scene, const LodOptions& options, PassContext& ctx)
      : scene_(scene),
        options_(options),
        ctx_(ctx),
        silent_(ctx),
        surfaces_(surfaces_of(scene)),
        reader_(scene, silent_, options.faces),
        nodes_(scene) {}

  Outcome run() {
    std::size_t n_lods = 0;
    look_around();
    for (std::size_t i = 0; i < surfaces_.size();) {
      auto& parts = read_batch(i);
      simplify(i, parts);
      for (std::size_t k = 0; k < parts.size(); ++k) n_lods += store(surfaces_[i + k], parts[k]);
      i += parts.size();
    }
    if (n_lods == 0) return Outcome::unchanged;
    nodes_.replace_shapes();
    return Outcome::changed;
  }

 private:
  /// What neighbours share, and how large they are in the scene, is known before the first is simplified.
  void look_around() {
    SharedBorders borders;
    Mesh mesh;
    bool any = false;
    for (const auto& surface : surfaces_) {
      reader_.read(surface, mesh);
      borders.add(mesh);
      any |= is_large(mesh);
    }
    fixed_.resize(surfaces_.size());
    scale_.resize(surfaces_.size(), 1);
    if (any) fixed_ = borders.find(scene_, surfaces_);
    if (any && !options_.errors.values.empty()) scale_ = world_scales(scene_, surfaces_, ctx_.resources);
  }

  bool is_large(const Mesh& mesh) const { return static_cast<int>(mesh.n_faces()) >= options_.min_faces; }

  /// The meshes of some surfaces from `first` on: as many as may lie in memory together.
  std::vector<Part>& read_batch(std::size_t first) {
    constexpr std::size_t most_corners = 3'000'000;
    batch_.clear();
    for (std::size_t corners = 0; first + batch_.size() < surfaces_.size() && corners < most_corners;) {
      auto& p = batch_.emplace_back();
      reader_.read(surfaces_[first + batch_.size() - 1], p.mesh);
      corners += p.mesh.corners.size();
    }
    return batch_;
  }

  void simplify(std::size_t first, std::vector<Part>& parts) const {
    parallel_for(parts.size(), [&](std::size_t i) {
      auto& p = parts[i];
      if (is_large(p.mesh)) p.levels = make_levels(p.mesh, levels_of(first + i));
    });
  }

  LevelOptions levels_of(std::size_t surface) const {
    LevelOptions levels{{.criterion = options_.criterion.value, .fixed = fixed_[surface]},
                        options_.ratios.values,
                        options_.errors.values,
                        options_.min_saving};
    for (double& e : levels.errors) e /= scale_[surface];
    return levels;
  }

  std::size_t store(const ShapeSurface& surface, const Part& part) {
    if (part.mesh.n_faces() == 0) return 0;
    const auto n = nodes_.add(surface, part.mesh, part.levels,
                              {options_.pixels, options_.screen_height, options_.field_of_view, options_.vanish});
    ctx_.stats[n ? "lod.shapes" : "lod.too-small"] += surface.shapes.size();
    ctx_.stats["lod.levels"] += n * part.levels.size();
    for (const auto& level : part.levels) ctx_.stats["lod.triangles"] += level.mesh.n_faces();
    return n;
  }

  const Scene& scene_;
  const LodOptions& options_;
  PassContext& ctx_;
  // The first level stays as it is: whoever draws it will say what is wrong with it.
  SilentTask silent_;
  std::vector<ShapeSurface> surfaces_;
  SurfaceReader reader_;
  LodNodes nodes_;
  // Of each surface: what is held fast, and metres of the world for its unit.
  std::vector<std::vector<std::uint32_t>> fixed_;
  std::vector<double> scale_;
  std::vector<Part> batch_;
};

/// The world at the shares of the triangles, and LODs over what its groups are there.
LodCounts lods_of_groups(Scene& scene, const WorldSimplifyOptions& world, const LodLimits& limits, PassContext& ctx) {
  SilentTask silent(ctx);
  LodCounts made;
  Scene with_lods;
  {
    const WorldLevels levels(scene, world, silent);
    if (levels.n_drawn() > WorldLevels::most_drawn)
      ctx.diag.report(Diag::not_simplified, {},
                      fmt::format("a world of more than {} triangles as a whole", WorldLevels::most_drawn));
    levels.report_missed(ctx.diag);
    if (levels.points().empty()) return made;
    std::vector<LeveledSurface> surfaces;
    with_lods = levels.scene_with_surfaces(surfaces);
    made = add_group_lods(with_lods, surfaces, limits);
  }
  if (made.n_lods > 0) scene = std::move(with_lods);
  return made;
}

/// LODs that are made from levels of the whole world.
Outcome lods_of_world(Scene& scene, const LodOptions& options, PassContext& ctx) {
  if (!options.errors.values.empty()) {
    ctx.diag.report(Diag::not_simplified, {}, "errors of lod are for scope=part; ratios are for all scopes");
    return Outcome::unchanged;
  }
  WorldSimplifyOptions world;
  world.collapse.criterion = options.criterion.value;
  world.ratios = options.ratios.values;
  world.text = options.scope == LodScope::group ? OfText::take : OfText::leave;
  const LodLimits limits{{options.pixels, options.screen_height, options.field_of_view, options.vanish},
                         options.min_saving,
                         static_cast<std::uint64_t>(options.min_faces)};
  const auto made =
      options.scope == LodScope::group
          ? lods_of_groups(scene, world, limits, ctx)
          : add_cell_lods(scene, {world, static_cast<std::size_t>(options.cell_triangles), options.faces, limits}, ctx);
  ctx.stats["lod.groups"] += made.n_lods;
  ctx.stats["lod.levels"] += made.n_levels;
  ctx.stats["lod.too-small"] += made.n_too_small;
  return made.n_lods > 0 ? Outcome::changed : Outcome::unchanged;
}

void report_inlines(const Scene& scene, Diagnostics& diag) {
  std::vector<NodeId> inlines = reachable(scene, scene.main);
  std::erase_if(inlines, [&](NodeId n) { return !scene.is(n, nodes::Inline); });
  if (inlines.empty()) return;
  const auto text = inlines.size() == 1 ? "an Inline" : std::to_string(inlines.size()) + " Inlines";
  diag.report(Diag::not_simplified, scene.where(inlines[0]), "the surfaces of " + text + "; use '-p inline,lod'");
}

std::string with_colons(const std::vector<double>& values) {
  std::string out;
  for (double v : values) {
    if (!out.empty()) out += ':';
    out += shortest_text(v);
  }
  return out;
}

}  // namespace

bool NumberList::read(std::string_view text) {
  values.clear();
  if (text.ends_with(':')) return false;
  while (!text.empty()) {
    double v;
    auto r = std::from_chars(text.data(), text.data() + text.size(), v);
    if (r.ec != std::errc{} || !std::isfinite(v) || v <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(r.ptr - text.data()));
    const bool percent = text.starts_with('%');
    text.remove_prefix(percent ? 1 : 0);
    values.push_back(percent ? v / 100 : v);
    if (values.back() > 1) return false;
    if (text.empty()) break;
    if (text[0] != ':') return false;
    text.remove_prefix(1);
  }
  return true;
}

std::string NumberList::print() const { return with_colons(values); }

bool LengthList::read(std::string_view text) {
  values.clear();
  if (text.ends_with(':')) return false;
  while (!text.empty()) {
    const auto end = std::min(text.find(':'), text.size());
    LengthOption length;
    if (!length.read(text.substr(0, end)) || !(length.metres > 0)) return false;
    values.push_back(length.metres);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return true;
}

std::string LengthList::print() const { return with_colons(values); }

Outcome lod(Scene& scene, const LodOptions& options, PassContext& ctx) {
  report_inlines(scene, ctx.diag);
  if (options.ratios.values.empty() && options.errors.values.empty())
    ctx.diag.report(Diag::not_simplified, {}, "lod has neither ratios nor errors, so it makes no levels");
  if (!options.errors.values.empty() && !options.ratios.values.empty() &&
      options.ratios.values != LodOptions{}.ratios.values)
    ctx.diag.report(Diag::option_ignored, {}, "option ratios of lod", "errors are given, and levels are made by them");
  return options.scope == LodScope::part ? Lod(scene, options, ctx).run() : lods_of_world(scene, options, ctx);
}

}  // namespace wrlkit
