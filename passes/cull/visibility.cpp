#include "passes/cull/visibility.h"

#include <algorithm>
#include <numbers>

#include "base/math/random.h"
#include "base/parallel.h"
#include "light/render/ray_scene.h"

namespace wrlkit {
namespace {

using namespace drawing;

constexpr double eye_height = 1.6, head_room = 1.8, up_facing = 0.9;
constexpr std::size_t most_eyes = 512;

struct Sample {
  V3 at, normal;
};

class Visibility {
 public:
  Visibility(const Stage& stage, const MeshPool& pool, std::span<const std::uint32_t> mesh_of,
             const VisibilityOptions& options, Diagnostics& diag)
      : stage_(stage),
        pool_(pool),
        mesh_of_(mesh_of),
        options_(options),
        rays_(stage, pool, mesh_of, {.cull = false, .clear = options.clear}, diag) {}

  std::vector<char> run(std::span<const V3> viewpoints) {
    eyes_.assign(viewpoints.begin(), viewpoints.end());
    if (options_.walkways) find_walkways();
    std::vector<char> out(mesh_of_.size());
    parallel_for(out.size(),
                 [&](std::size_t u) { out[u] = options_.wanted[u] && is_hidden(static_cast<std::uint32_t>(u)); });
    return out;
  }

 private:
  const PooledMesh& mesh(std::uint32_t use) const { return pool_[mesh_of_[use]]; }
  std::array<V3, 3> triangle(std::uint32_t use, std::size_t element) const {
    const PooledMesh& m = mesh(use);
    const Affine& frame = stage_.frames[stage_.uses[use].frame];
    std::array<V3, 3> t;
    for (int k = 0; k < 3; ++k) t[static_cast<std::size_t>(k)] = frame.point(m.origin + pool_.position(m, element, k));
    return t;
  }

  /// Running sums of the areas of a use's triangles.
  std::vector<double> areas(std::uint32_t use) const {
    std::vector<double> sums;
    double sum = 0;
    for (std::size_t e = 0; e < mesh(use).n_elements; ++e) {
      const auto t = triangle(use, e);
      const double a = length(cross(t[1] - t[0], t[2] - t[0])) / 2;
      sums.push_back(sum += std::isfinite(a) ? a : 0);
    }
    return sums;
  }

  Sample sample(std::uint32_t use, std::span<const double> sums, RandomStream& random) const {
    const auto e = std::min<std::size_t>(
        static_cast<std::size_t>(std::ranges::upper_bound(sums, random.next() * sums.back()) - sums.begin()),
        sums.size() - 1);
    const auto t = triangle(use, e);
    const double r = std::sqrt(random.next()), s = random.next();
    return {t[0] + (r * (1 - s)) * (t[1] - t[0]) + (r * s) * (t[2] - t[0]), unit(cross(t[1] - t[0], t[2] - t[0]))};
  }

  /// Off the face, to the side that the ray goes to.
  bool is_free(const Sample& from, const V3& direction, double distance) const {
    const double side = dot(from.normal, direction) < 0 ? -1 : 1, off = 1e-5 * std::max(rays_.radius(), 1e-3);
    return !rays_.occluded({from.at + (side * off) * from.normal, direction}, off, distance);
  }

  bool is_hidden(std::uint32_t use) const {
    const PooledMesh& m = mesh(use);
    if (m.kind != Mesh::Kind::faces || m.n_elements == 0) return false;
    const auto sums = areas(use);
    if (!(sums.back() > 0)) return false;
    RandomStream random(random_key(options_.seed, use));
    for (int i = 0; i < options_.rays; ++i) {
      const Sample s = sample(use, sums, random);
      const double z = 2 * random.next() - 1, turn = 2 * std::numbers::pi * random.next(),
                   r = std::sqrt(std::max(0.0, 1 - z * z));
      if (is_free(s, {r * std::cos(turn), r * std::sin(turn), z}, std::numeric_limits<double>::infinity()))
        return false;
      if (eyes_.empty()) continue;
      const V3 way = eyes_[static_cast<std::size_t>(random.next() * static_cast<double>(eyes_.size()))] - s.at;
      if (const double d = length(way); !(d > 0) || is_free(s, (1 / d) * way, d)) return false;
    }
    return true;
  }

  void find_walkways() {
    // Uses by the area of what faces up.
    std::vector<double> sums;
    std::vector<std::uint32_t> uses;
    double sum = 0;
    auto faces_up = [](const std::array<V3, 3>& t) {
      return std::abs(unit(cross(t[1] - t[0], t[2] - t[0])).y) > up_facing;
    };
    for (std::uint32_t u = 0; u < mesh_of_.size(); ++u) {
      if (mesh(u).kind != Mesh::Kind::faces) continue;
      double area = 0;
      for (std::size_t e = 0; e < mesh(u).n_elements; ++e)
        if (const auto t = triangle(u, e); faces_up(t)) area += length(cross(t[1] - t[0], t[2] - t[0])) / 2;
      if (!(area > 0) || !std::isfinite(area)) continue;
      sums.push_back(sum += area);
      uses.push_back(u);
    }
    if (uses.empty()) return;
    for (std::size_t i = 0; i < 4 * most_eyes && eyes_.size() < most_eyes; ++i) {
      RandomStream random(random_key(options_.seed, i, 1));
      const auto k = std::min<std::size_t>(
          static_cast<std::size_t>(std::ranges::upper_bound(sums, random.next() * sums.back()) - sums.begin()),
          sums.size() - 1);
      const auto of_use = areas(uses[k]);
      const Sample s = sample(uses[k], of_use, random);
      if (std::abs(s.normal.y) > up_facing && is_free(s, {0, 1, 0}, head_room))
        eyes_.push_back(s.at + V3(0, eye_height, 0));
    }
  }

  const Stage& stage_;
  const MeshPool& pool_;
  std::span<const std::uint32_t> mesh_of_;
  VisibilityOptions options_;
  RayScene rays_;
  std::vector<V3> eyes_;
};

}  // namespace

std::vector<char> hidden_uses(const Stage& stage, const MeshPool& pool, std::span<const std::uint32_t> mesh_of,
                              std::span<const V3> viewpoints, const VisibilityOptions& options, Diagnostics& diag) {
  return Visibility(stage, pool, mesh_of, options, diag).run(viewpoints);
}

}  // namespace wrlkit
