#include "geometry/simplify/simplifier.h"

#include "geometry/simplify/engine.h"

namespace wrlkit::simplify {

void Simplifier::write(Mesh& mesh) const {
  std::vector<std::uint32_t> id(surface_.n_vertices(), none);
  auto& positions = mesh.positions.edit();
  for (std::uint32_t f = 0; f < surface_.n_slots(); ++f) {
    if (!surface_.alive(f)) continue;
    for (std::uint32_t v : surface_.face[f].v) {
      if (id[v] == none) {
        id[v] = static_cast<std::uint32_t>(positions.size() / 3);
        const Vec3& p = surface_.position(v);
        positions.insert(positions.end(), p.begin(), p.end());
      }
      mesh.corners.push_back(id[v]);
    }
  }
  wedges_.write(mesh, surface_);
}

std::unique_ptr<Simplifier> make_simplifier(const Mesh& mesh, const CollapseOptions& options) {
  if (options.criterion == Criterion::meshopt) return meshopt_simplifier(mesh, !options.fixed.empty());
  return std::make_unique<Engine>(mesh, options);
}

}  // namespace wrlkit::simplify
