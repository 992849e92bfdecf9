#include "light/patches/patched_world.h"

#include <algorithm>

#include "base/parallel.h"
#include "light/patches/patch_match.h"

namespace wrlkit::light {
namespace {

using drawing::PooledMesh;

constexpr double patches_as_a_rule = 20'000;
constexpr std::size_t side_block = 1024;  // of work in parallel

}  // namespace

PatchedWorld::PatchedWorld(const LightWorld& world, const PatchSizes& sizes, Diagnostics& diag)
    : world_(world), sizes_(sizes) {
  if (!(sizes_.max_edge > 0) && !(sizes_.max_area > 0))
    sizes_.max_edge = std::sqrt(3 * total_area() / patches_as_a_rule);
  cut(diag);
  number_sides();
}

/// In the order of the front, as SurfacePoint has it.
std::vector<std::array<V3, 3>> PatchedWorld::triangles_of(std::uint32_t use) const {
  const PooledMesh& m = world_.meshes()[world_.mesh_of()[use]];
  const bool mirrored = world_.stage().frames[world_.stage().uses[use].frame].determinant() < 0;
  std::vector<std::array<V3, 3>> out(m.n_elements);
  for (std::uint32_t e = 0; e < m.n_elements; ++e) {
    out[e] = triangle_of(world_, use, e);
    if (mirrored) std::swap(out[e][1], out[e][2]);
  }
  return out;
}

double PatchedWorld::total_area() const {
  double sum = 0;
  for (std::uint32_t u = 0; u < world_.stage().uses.size(); ++u) {
    if (world_.meshes()[world_.mesh_of()[u]].kind != Mesh::Kind::faces) continue;
    const double n_sides = world_.meshes()[world_.mesh_of()[u]].solid ? 1 : 2;
    for (const auto& t : triangles_of(u)) sum += n_sides * 0.5 * length(cross(t[1] - t[0], t[2] - t[0]));
  }
  return sum;
}

void PatchedWorld::cut(Diagnostics& diag) {
  const PatchSizes asked = sizes_;
  if (const double least = least_patches(), most = static_cast<double>(sizes_.most_patches); least > most)
    enlarge(std::sqrt(least / most));
  while (!try_to_cut()) {
    enlarge(1.5);
    // A scene of more triangles than that is taken as it is.
    if (!std::isfinite(sizes_.max_edge + sizes_.max_area)) break;
  }
  if (sizes_.max_edge > asked.max_edge || sizes_.max_area > asked.max_area)
    diag.report(Diag::patch_limit, {}, sizes_.most_patches,
                sizes_.max_edge > 0 ? sizes_.max_edge / asked.max_edge : std::sqrt(sizes_.max_area / asked.max_area));
}

void PatchedWorld::enlarge(double factor) {
  sizes_.max_edge *= factor;
  sizes_.max_area *= factor * factor;
}

/// So many there are at least, if all have the largest area that they may have.
double PatchedWorld::least_patches() const {
  constexpr double equilateral = 0.43301270189221932;  // area of a triangle of edges of 1
  double largest = sizes_.max_area > 0 ? sizes_.max_area : HUGE_VAL;
  if (sizes_.max_edge > 0) largest = std::min(largest, equilateral * sizes_.max_edge * sizes_.max_edge);
  return total_area() / largest;
}

bool PatchedWorld::try_to_cut() {
  uses_.clear();
  uses_.resize(world_.stage().uses.size());
  std::size_t n = 0;
  for (std::uint32_t u = 0; u < uses_.size(); ++u) {
    const PooledMesh& m = world_.meshes()[world_.mesh_of()[u]];
    if (m.kind != Mesh::Kind::faces || m.n_elements == 0) continue;
    uses_[u].mesh = std::make_unique<PatchMesh>(triangles_of(u));
    uses_[u].both_sides = !m.solid;
    const std::size_t n_sides = 1 + !m.solid;
    if (!uses_[u].mesh->split_to(sizes_.max_edge, sizes_.max_area,
                                 (sizes_.most_patches - std::min(n, sizes_.most_patches)) / n_sides))
      return false;
    n += n_sides * uses_[u].mesh->faces().size();
  }
  return true;
}

void PatchedWorld::number_sides() {
  sides_.clear();
  for (std::uint32_t u = 0; u < uses_.size(); ++u) {
    uses_[u].first = static_cast<std::uint32_t>(sides_.size());
    if (!uses_[u].mesh) continue;
    const auto n = static_cast<std::uint32_t>(uses_[u].mesh->faces().size());
    for (int back = 0; back <= uses_[u].both_sides; ++back)
      for (std::uint32_t f = 0; f < n; ++f) sides_.push_back({u, f, back == 1});
  }
  areas_.resize(sides_.size());
  albedo_.resize(sides_.size());
  emission_.resize(sides_.size());
  parallel_for((sides_.size() + side_block - 1) / side_block, [&](std::size_t b) {
    for (std::size_t s = b * side_block; s < std::min(sides_.size(), (b + 1) * side_block); ++s)
      paint(static_cast<std::uint32_t>(s));
  });
}

void PatchedWorld::paint(std::uint32_t s) {
  const Side& side = sides_[s];
  const PatchMesh& m = mesh(side.use);
  areas_[s] = m.area(side.face);
  const auto color = color_of(world_, side.use, m.faces()[side.face].triangle, side.back, m.corners(side.face));
  albedo_[s] = color.albedo;
  emission_[s] = color.emission;
}

Receiver PatchedWorld::receiver(std::uint32_t s, double u, double v) const {
  const Side& side = sides_[s];
  const auto c = mesh(side.use).corners(side.face);
  const double root = std::sqrt(u);
  const V3 e1 = c[1] - c[0], e2 = c[2] - c[0], p = c[0] + (root * (1 - v)) * e1 + (root * v) * e2;
  V3 face = unit(cross(e1, e2));
  if (side.back) face = -face;
  const auto t = triangle_of(world_, side.use, mesh(side.use).faces()[side.face].triangle);
  return {world_.off_surface(p, face, std::max(length(t[1] - t[0]), length(t[2] - t[0]))), face, face,
          world_.stage().uses[side.use].lights};
}

std::uint32_t PatchedWorld::side_at(const Hit& hit, const V3& position) const {
  const Use& use = uses_[hit.use];
  if (!use.mesh || (hit.back && !use.both_sides)) return none;
  const auto face = use.mesh->locate(hit.element, position);
  return use.first + face + (hit.back ? static_cast<std::uint32_t>(use.mesh->faces().size()) : 0);
}

void PatchedWorld::refine(std::span<const std::uint32_t> sides) {
  // A face that was cut on the way to another one is small enough for now.
  std::vector<std::pair<Side, double>> wanted;
  for (auto s : sides) wanted.emplace_back(sides_[s], areas_[s]);
  for (const auto& [side, area] : wanted)
    if (PatchMesh& m = *uses_[side.use].mesh; m.area(side.face) == area) m.split(side.face);
  number_sides();
}

}  // namespace wrlkit::light
