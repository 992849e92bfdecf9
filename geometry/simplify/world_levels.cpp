#include "geometry/simplify/world_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "base/math/saturating.h"
#include "base/parallel.h"
#include "geometry/geometry.h"
#include "geometry/simplify/level_meshes.h"
#include "geometry/simplify/world_parts.h"
#include "scenegraph/nodes.h"

namespace wrlkit {

struct WorldLevels::Impl {
  const Scene& scene;
  WorldSimplifyOptions options;
  simplify::WorldParts world;
  std::vector<Point> points{};
  std::vector<std::vector<std::uint32_t>> rungs{};  // by point, of each part
  std::vector<std::vector<double>> errors{};        // by point, of each part, in metres

  /// Triangles of the world that shares are of.
  std::size_t drawn() const { return options.drawn ? options.drawn : saturating_add(world.n_drawn, world.n_left); }
  void allocate();
  std::size_t left_for_parts(std::size_t count) const;
  double error(const simplify::PlacedSurface& s, std::size_t point) const;
  using UseMesh = std::function<void(std::size_t surface, std::size_t point, Mesh mesh)>;
  /// A surface, and points at which it is to be made.
  struct Wanted {
    std::size_t surface;
    std::vector<std::size_t> points;
  };
  void make_meshes(std::span<const Wanted> wanted, const UseMesh& use) const;
  /// Where each surface is another one than at the point before; at the first, than that of the scene.
  std::vector<Wanted> changed() const;
  void for_each_changed(const UseMesh& use) const;
  struct Kept {
    std::size_t surface, point;
    Mesh mesh;
  };
  std::vector<Kept> kept{};  // all that have changed, once a scene has been asked for: others will be
  void keep();
};

/// Triangles of the parts where the world is to have `count`. What stays as it is can be most of them: to make up for
/// it, the parts give half of their own share at most, and for nothing no more than to what a box has.
std::size_t WorldLevels::Impl::left_for_parts(std::size_t count) const {
  if (world.n_left == 0) return count;
  const double share = static_cast<double>(count) / static_cast<double>(drawn());
  const auto half = static_cast<std::size_t>(share / 2 * static_cast<double>(world.n_drawn));
  return count > world.n_left ? std::max(count - world.n_left, half) : std::max(faces_of_a_box, half);
}

void WorldLevels::Impl::allocate() {
  simplify::Allocation allocation(world.allocated, world.neighbours, world.area);
  auto before = allocation.n_drawn();
  for (const auto count : counts_of(options, drawn())) {
    allocation.run_to(left_for_parts(count));
    if (allocation.n_drawn() == before) continue;
    before = allocation.n_drawn();
    Point point{before + world.n_left, world.n_left, allocation.n_gone(), allocation.rms(), allocation.max()};
    const auto& at = rungs.emplace_back(allocation.rungs());
    errors.push_back(allocation.maxima());
    for (std::size_t i = 0; i < world.parts.size(); ++i)
      if (at[i] != simplify::Allocation::gone) point.n_faces += (*world.allocated[i].rungs)[at[i]].n_faces;
    points.push_back(point);
  }
}

/// In the units of the surface.
double WorldLevels::Impl::error(const simplify::PlacedSurface& s, std::size_t point) const {
  const auto first = errors[point].begin() + s.first_part;
  return *std::max_element(first, first + s.n_parts) / s.scale;
}

/// In order, while the threads make some at a time.
void WorldLevels::Impl::make_meshes(std::span<const Wanted> wanted, const UseMesh& use) const {
  constexpr std::size_t at_once = 256;
  for (std::size_t first = 0; first < wanted.size(); first += at_once) {
    const auto some = wanted.subspan(first, std::min(at_once, wanted.size() - first));
    std::vector<std::vector<Mesh>> meshes(some.size());
    parallel_for(some.size(), [&](std::size_t i) {
      std::vector<std::reference_wrapper<const simplify::Rungs>> at;
      for (const auto point : some[i].points) at.emplace_back(rungs[point]);
      meshes[i] = simplify::level_meshes(world, world.surfaces[some[i].surface], at);
    });
    for (std::size_t i = 0; i < some.size(); ++i)
      for (std::size_t k = 0; k < meshes[i].size(); ++k)
        use(some[i].surface, some[i].points[k], std::move(meshes[i][k]));
  }
}

std::vector<WorldLevels::Impl::Wanted> WorldLevels::Impl::changed() const {
  std::vector<Wanted> out;
  for (std::size_t i = 0; i < world.surfaces.size(); ++i) {
    Wanted wanted{i, {}};
    for (std::size_t k = 0; k < rungs.size(); ++k)
      if (world.is_changed(world.surfaces[i], rungs[k], k > 0 ? &rungs[k - 1] : nullptr)) wanted.points.push_back(k);
    if (!wanted.points.empty()) out.push_back(std::move(wanted));
  }
  return out;
}

void WorldLevels::Impl::for_each_changed(const UseMesh& use) const {
  if (kept.empty()) return make_meshes(changed(), use);
  for (const auto& m : kept) use(m.surface, m.point, m.mesh);
}

void WorldLevels::Impl::keep() {
  if (!kept.empty()) return;
  make_meshes(changed(), [&](std::size_t surface, std::size_t point, Mesh mesh) {
    kept.push_back({surface, point, std::move(mesh)});
  });
}

WorldLevels::WorldLevels(const Scene& scene, const WorldSimplifyOptions& options, Task& ctx)
    : impl_(new Impl{scene, options,
                     simplify::WorldParts(scene, options.expanded ? *options.expanded : scene, options.collapse,
                                          options.text, ctx)}) {
  if (n_parts() < (options.one_part ? 1 : 2) || counts_of(options, n_drawn()).empty()) return;
  impl_->world.make_ladders();
  impl_->allocate();
}

WorldLevels::~WorldLevels() = default;

static_assert(WorldLevels::most_drawn == simplify::WorldParts::most_drawn);
std::size_t WorldLevels::n_drawn() const { return impl_->drawn(); }
std::size_t WorldLevels::n_faces() const { return impl_->world.n_faces + impl_->world.n_left; }
bool WorldLevels::is_drawn_once() const { return impl_->world.n_drawn == impl_->world.n_faces; }
std::size_t WorldLevels::n_parts() const { return impl_->world.parts.size(); }
const std::vector<WorldLevels::Point>& WorldLevels::points() const { return impl_->points; }

std::size_t WorldLevels::n_texts_as_faces() const {
  const auto is_changed = [&](const simplify::PlacedSurface& s) {
    return s.is_text &&
           std::ranges::any_of(impl_->rungs, [&](const auto& at) { return impl_->world.is_changed(s, at); });
  };
  return static_cast<std::size_t>(std::ranges::count_if(impl_->world.surfaces, is_changed));
}

std::optional<std::size_t> WorldLevels::missed() const {
  if (impl_->world.n_left == 0) return std::nullopt;
  const auto counts = counts_of(impl_->options, n_drawn());
  const auto fewest = points().empty() ? n_drawn() : points().back().n_drawn;
  const auto found = std::ranges::find_if(counts, [&](std::size_t count) { return count < fewest; });
  return found == counts.end() ? std::nullopt : std::optional(*found);
}

void WorldLevels::report_missed(Diagnostics& diag) const {
  const auto count = missed();
  if (!count) return;
  std::string causes;
  for (const auto& [why, n] : impl_->world.left) causes += fmt::format("{}{} {}", causes.empty() ? "" : ", ", n, why);
  diag.report(
      Diag::not_simplified, {},
      fmt::format("{} of {} triangles, so {} cannot be reached: {}", impl_->world.n_left, n_drawn(), *count, causes));
}

Scene WorldLevels::scene_at(std::size_t i) const {
  impl_->keep();
  Scene out = impl_->scene;
  const auto& kept = impl_->kept;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const bool is_last = k + 1 == kept.size() || kept[k + 1].surface != kept[k].surface || kept[k + 1].point > i;
    if (kept[k].point > i || !is_last) continue;
    const auto& surface = impl_->world.surfaces[kept[k].surface].surface;
    if (!kept[k].mesh.corners.empty())
      store_mesh(out, surface.geometry, kept[k].mesh);
    else
      for (const NodeId shape : surface.shapes) out.unset(shape, nodes::shape::geometry.slot);
  }
  return out;
}

void WorldLevels::for_each_mesh(std::span<const std::vector<std::uint32_t>> levels, const UseMesh& use) const {
  const auto& world = impl_->world;
  std::vector<Impl::Wanted> wanted;
  std::vector<std::size_t> level_of;  // of each mesh, in order
  for (std::size_t i = 0; i < world.surfaces.size(); ++i) {
    Impl::Wanted of_surface{i, {}};
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const auto point = levels[k][world.surfaces[i].surface.geometry.value];
      if (point == as_it_was || !world.is_changed(world.surfaces[i], impl_->rungs[point])) continue;
      of_surface.points.push_back(point);
      level_of.push_back(k);
    }
    if (!of_surface.points.empty()) wanted.push_back(std::move(of_surface));
  }
  auto level = level_of.begin();
  impl_->make_meshes(wanted, [&](std::size_t surface, std::size_t, Mesh mesh) {
    use(*level++, world.surfaces[surface].surface.geometry, std::move(mesh));
  });
}

std::vector<std::size_t> WorldLevels::faces_at(std::size_t i) const {
  std::vector<std::size_t> out(impl_->scene.node_count());
  const auto& world = impl_->world;
  for (const auto& s : world.surfaces)
    for (auto part = s.first_part; part < s.first_part + s.n_parts; ++part)
      if (const auto rung = impl_->rungs[i][part]; rung != simplify::Allocation::gone)
        out[s.surface.geometry.value] += (*world.allocated[part].rungs)[rung].n_faces;
  return out;
}

Scene WorldLevels::scene_with_levels() const {
  Scene out = impl_->scene;
  LodNodes nodes(out);
  const auto& surfaces = impl_->world.surfaces;
  std::vector<MeshLevel> levels;  // of the surface at hand
  std::size_t at_hand = 0;
  const auto add_until = [&](std::size_t end) {
    for (; at_hand < end; levels.clear(), ++at_hand)
      nodes.add(surfaces[at_hand].surface, surfaces[at_hand].mesh, levels, impl_->options.budget);
  };
  impl_->for_each_changed([&](std::size_t n, std::size_t k, Mesh mesh) {
    add_until(n);
    if (!levels.empty() && levels.back().mesh.n_faces() == mesh.n_faces()) return;
    levels.push_back({std::move(mesh), 0, impl_->error(surfaces[n], k)});
  });
  add_until(surfaces.size());
  nodes.replace_shapes();
  return out;
}

Scene WorldLevels::scene_with_surfaces(std::vector<LeveledSurface>& surfaces) const {
  Scene out = impl_->scene;
  const auto first = surfaces.size();
  for (const auto& s : impl_->world.surfaces) {
    const auto triangles = triangles_of(s.mesh);
    const SurfaceLevel unchanged{s.surface.geometry, 0, s.mesh.n_faces()};
    auto& leveled = surfaces.emplace_back(LeveledSurface{s.surface, {}, {unchanged}});
    for (const auto c : s.mesh.corners) leveled.bounds.add(triangles.position(c));
    leveled.levels.resize(impl_->rungs.size() + 1, unchanged);
    for (std::size_t k = 0; k < impl_->rungs.size(); ++k) leveled.levels[k + 1].error = impl_->error(s, k);
  }
  impl_->for_each_changed([&](std::size_t n, std::size_t k, const Mesh& mesh) {
    auto& leveled = surfaces[first + n];
    NodeId geometry{};
    if (!mesh.corners.empty()) {
      geometry = out.add(nodes::IndexedFaceSet, out.where(leveled.surface.geometry));
      store_mesh(out, geometry, mesh);
    }
    for (auto later = k + 1; later < leveled.levels.size(); ++later) {
      leveled.levels[later].geometry = geometry;
      leveled.levels[later].n_faces = mesh.n_faces();
    }
  });
  return out;
}

}  // namespace wrlkit
