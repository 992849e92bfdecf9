#include "geometry/simplify/world_levels.h"

#include <algorithm>
#include <functional>

#include "geometry/geometry.h"
#include "geometry/simplify/world_parts.h"
#include "scenegraph/nodes.h"

namespace wrlkit {

struct WorldLevels::Impl {
  const Scene& scene;
  WorldSimplifyOptions options;
  simplify::WorldParts world;
  std::vector<Point> points{};
  std::vector<std::vector<std::uint32_t>> rungs{};  // by point, of each part

  /// Triangles of the world that shares are of.
  std::size_t drawn() const { return options.drawn ? options.drawn : world.n_drawn + world.n_left; }
  std::vector<std::size_t> counts() const;
  void allocate();
};

std::vector<std::size_t> WorldLevels::Impl::counts() const {
  const std::size_t n = drawn();
  std::vector<std::size_t> out = options.counts;
  if (options.every > 0 && n > 0)
    for (std::size_t k = (n - 1) / options.every * options.every; k > 0; k -= options.every) out.push_back(k);
  for (double r : options.ratios) out.push_back(static_cast<std::size_t>(r * static_cast<double>(n)));
  std::erase_if(out, [&](std::size_t k) { return k >= n; });
  std::ranges::sort(out, std::greater{});
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void WorldLevels::Impl::allocate() {
  simplify::Allocation allocation(world.allocated, world.neighbours, world.area);
  auto before = allocation.n_drawn();
  for (const auto count : counts()) {
    allocation.run_to(count > world.n_left ? count - world.n_left : 0);
    if (allocation.n_drawn() == before) continue;
    before = allocation.n_drawn();
    Point point{before + world.n_left, world.n_left, allocation.n_gone(), allocation.rms(), allocation.max()};
    const auto& at = rungs.emplace_back(allocation.rungs());
    for (std::size_t i = 0; i < world.parts.size(); ++i)
      if (at[i] != simplify::Allocation::gone) point.n_faces += (*world.allocated[i].rungs)[at[i]].n_faces;
    points.push_back(point);
  }
}

WorldLevels::WorldLevels(const Scene& scene, const WorldSimplifyOptions& options, Task& ctx)
    : impl_(new Impl{scene, options, simplify::WorldParts(scene, options.collapse, ctx)}) {
  if (n_parts() < 2 || impl_->counts().empty()) return;
  impl_->world.make_ladders();
  impl_->allocate();
}

WorldLevels::~WorldLevels() = default;

std::size_t WorldLevels::n_drawn() const { return impl_->drawn(); }
std::size_t WorldLevels::n_faces() const { return impl_->world.n_faces + impl_->world.n_left; }
std::size_t WorldLevels::n_parts() const { return impl_->world.parts.size(); }
const std::vector<WorldLevels::Point>& WorldLevels::points() const { return impl_->points; }

Scene WorldLevels::scene_at(std::size_t i) const {
  Scene out = impl_->scene;
  const auto& world = impl_->world;
  for (const auto& s : world.surfaces) {
    if (!world.is_changed(s, impl_->rungs[i])) continue;
    const Mesh mesh = world.mesh_at(s, impl_->rungs[i]);
    if (!mesh.corners.empty())
      store_mesh(out, s.surface.geometry, mesh);
    else
      for (NodeId shape : s.surface.shapes) out.unset(shape, nodes::shape::geometry.slot);
  }
  return out;
}

Scene WorldLevels::scene_with_levels() const {
  Scene out = impl_->scene;
  LodNodes nodes(out);
  const auto& world = impl_->world;
  for (const auto& s : world.surfaces) {
    std::vector<MeshLevel> levels;
    for (const auto& at : impl_->rungs) {
      if (!world.is_changed(s, at)) continue;
      Mesh mesh = world.mesh_at(s, at);
      if (!levels.empty() && levels.back().mesh.n_faces() == mesh.n_faces()) continue;
      double error = 0;
      for (std::uint32_t i = s.first_part; i < s.first_part + s.n_parts; ++i) {
        const auto& part = world.allocated[i];
        error = std::max(error, part.max(std::min<std::size_t>(at[i], part.rungs->size() - 1)));
      }
      levels.push_back({std::move(mesh), 0, error / s.scale});
    }
    nodes.add(s.surface, s.mesh, levels, impl_->options.budget);
  }
  nodes.replace_shapes();
  return out;
}

}  // namespace wrlkit
