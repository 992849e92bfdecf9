#include "light/patches/illuminate.h"

#include <algorithm>
#include <numeric>

#include "base/math/random.h"

namespace wrlkit::light {
namespace {

Corners corners_of(const std::array<V3, 3>& t) { return {Vec3(t[0]), Vec3(t[1]), Vec3(t[2])}; }

/// The faces of a mesh by the triangles that they are pieces of: those of t are order[first[t]] to order[first[t + 1] -
/// 1].
struct ByTriangle {
  std::vector<std::uint32_t> first, order;

  explicit ByTriangle(const PatchMesh& mesh) : first(mesh.n_triangles() + 1), order(mesh.faces().size()) {
    for (const auto& f : mesh.faces()) ++first[f.triangle + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    auto next = first;
    for (std::uint32_t f = 0; f < order.size(); ++f) order[next[mesh.faces()[f].triangle]++] = f;
  }
};

/// Splits patches where the light changes, by what a few steps of stochastic iteration say of it. Two runs have to say
/// so, as neighbours differ by noise as well.
class Refinement {
 public:
  Refinement(PatchedWorld& world, const IlluminateOptions& options) : world_(world), options_(options) {}

  void run() {
    constexpr int rounds = 6;  // each halves the area; two halve the edges
    for (std::uint64_t round = 0; round < rounds; ++round) {
      for (std::uint64_t i = 0; i < 2; ++i) look(pilot_[i], random_key(options_.how.seed, 40 + i, round));
      const auto chosen = where_it_changes();
      constexpr std::size_t added = 4;  // sides by each, about: neighbours are cut, too
      if (chosen.empty() || world_.n_sides() + added * chosen.size() > world_.sizes().most_patches) return;
      world_.refine(chosen);
    }
  }

 private:
  void look(std::vector<double>& brightness, std::uint64_t seed) const {
    constexpr int samples = 64;
    const auto irradiance = iterate_stochastically(world_, {.samples = samples, .seed = seed});
    brightness.resize(irradiance.size());
    for (std::uint32_t s = 0; s < irradiance.size(); ++s) brightness[s] = mean(radiance(world_, s, irradiance[s]));
  }

  /// The largest that an edge may be, or is about when only the area is limited.
  double edge() const {
    return world_.sizes().max_edge > 0 ? world_.sizes().max_edge : 2 * std::sqrt(world_.sizes().max_area);
  }

  double threshold() const {
    double sum = 0, area = 0;
    for (std::uint32_t s = 0; s < world_.n_sides(); ++s) {
      sum += world_.area(s) * (pilot_[0][s] - mean(world_.emission(s)));
      area += world_.area(s);
    }
    return area > 0 ? options_.gradient * sum / area : 0;
  }

  std::vector<std::uint32_t> where_it_changes() const {
    std::vector<std::uint32_t> out;
    const double most = threshold(), shortest = edge() / 8;
    for (std::uint32_t s = 0; s < world_.n_sides(); ++s) {
      const auto [use, face, back] = world_.side(s);
      const auto& mesh = world_.mesh(use);
      if (mesh.longest(face) <= shortest) continue;
      const auto first = s - face;
      // Around a fold light changes at once, however small patches are.
      auto differs = [&, face = face](std::uint32_t n) {
        if (n == PatchMesh::none || !mesh.flat(face, n)) return false;
        const double a = pilot_[0][first + n] - pilot_[0][s], b = pilot_[1][first + n] - pilot_[1][s];
        return std::min(a, b) > most || std::max(a, b) < -most;
      };
      if (std::ranges::any_of(mesh.faces()[face].neighbours, differs)) out.push_back(s);
    }
    return out;
  }

  PatchedWorld& world_;
  const IlluminateOptions& options_;
  std::vector<double> pilot_[2];  // radiance of each side
};

class Gathering {
 public:
  Gathering(const PatchedWorld& world, const std::vector<V3>& irradiance, PatchSet& to)
      : world_(world), irradiance_(irradiance), set_(to) {}

  void add_use(std::uint32_t use) {
    const PatchMesh& mesh = world_.mesh(use);
    const ByTriangle pieces(mesh);
    for (std::uint32_t t = 0; t < mesh.n_triangles(); ++t) {
      if (!(mesh.triangle_area(t) > 0)) continue;
      set_.add_triangle(t, corners_of(mesh.triangle(t)));
      for (auto i = pieces.first[t]; i < pieces.first[t + 1]; ++i) add_face(use, mesh, pieces.order[i]);
    }
  }

 private:
  void add_face(std::uint32_t use, const PatchMesh& mesh, std::uint32_t face) {
    const auto front = world_.first_side(use) + face;
    add_side(mesh, face, front, false);
    if (world_.both_sides(use)) add_side(mesh, face, front + static_cast<std::uint32_t>(mesh.faces().size()), true);
  }
  void add_side(const PatchMesh& mesh, std::uint32_t face, std::uint32_t side, bool back) {
    const V3 l = radiance(world_, side, irradiance_[side]);
    set_.patches.push_back({corners_of(mesh.corners(face)),
                            {static_cast<float>(l.x), static_cast<float>(l.y), static_cast<float>(l.z)},
                            back});
  }

  const PatchedWorld& world_;
  const std::vector<V3>& irradiance_;
  PatchSet& set_;
};

}  // namespace

PatchSet illuminate(const Scene& scene, const LightWorld& world, const IlluminateOptions& options, Diagnostics& diag) {
  PatchedWorld patched(world, options.sizes, diag);
  if (options.gradient > 0) Refinement(patched, options).run();
  const auto irradiance = illuminate(patched, options.method, options.how);
  PatchSet set;
  set.samples = static_cast<std::uint32_t>(options.how.samples);
  set.patches.reserve(patched.n_sides());
  Gathering gathering(patched, irradiance, set);
  for (std::uint32_t u = 0; u < patched.n_uses(); ++u) {
    if (!patched.has_patches(u)) continue;
    set.add_shape(full_name(scene, world.stage(), world.stage().uses[u]), u);
    gathering.add_use(u);
  }
  return set;
}

}  // namespace wrlkit::light
