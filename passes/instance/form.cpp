#include "passes/instance/form.h"

#include "base/math/eigen.h"

#include <algorithm>
#include <bit>

#include "base/hashing.h"

namespace wrlkit::instancing {

void MeshForm::take(const Mesh& m) {
  mesh = &m;
  at.resize(m.corners.size());
  centre = {};
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double* p = m.positions.data() + std::size_t{m.corners[i]} * 3;
    at[i] = {p[0], p[1], p[2]};
    for (std::size_t k = 0; k < 3; ++k) centre[k] += (p[k] - centre[k]) / static_cast<double>(i + 1);
  }
  std::array<std::array<double, 3>, 3> moments{}, axes{};
  double farthest = 0;
  for (Vec3& p : at) {
    for (std::size_t k = 0; k < 3; ++k) p[k] -= centre[k];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) moments[i][k] += p[i] * p[k];
    farthest = std::max(farthest, p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  }
  const double n = std::max<double>(1, static_cast<double>(at.size()));
  size = std::sqrt((moments[0][0] + moments[1][1] + moments[2][2]) / n);
  reach = std::sqrt(farthest);
  diagonalise(moments, axes, spread);
  for (double& s : spread) s = std::sqrt(std::max(0.0, s / n));
  std::ranges::sort(spread, std::greater<>());
}

std::uint64_t MeshForm::exact_key() const {
  const Mesh& m = *mesh;
  std::uint64_t h = mixed(static_cast<std::uint64_t>(m.kind) * 8 + m.ccw * 4 + m.solid * 2 + m.convex,
                          std::bit_cast<std::uint64_t>(m.crease_angle));
  h = mixed(mixed(h, m.n_faces()), m.corners.size());
  for (const Attribute* a : m.attributes()) h = mixed(h, a->present() ? static_cast<std::uint64_t>(a->width) : 0);
  // Sums, as faces may come in any order.
  std::uint64_t sizes = 0, colors = 0;
  for (std::size_t f = 0; f < m.n_faces(); ++f) sizes += mixed(m.end_of(f) - m.begin_of(f), 1);
  for (auto i : m.color.index) {
    std::uint64_t c = 0;
    for (int k = 0; k < m.color.width; ++k) c = mixed(c, std::bit_cast<std::uint32_t>(m.color.at(i)[k]));
    colors += c;
  }
  return mixed(mixed(h, sizes), colors);
}

std::vector<double> invariants(const MeshForm& f, Scaling scaling, double tolerance) {
  constexpr double steps = 64;
  if (!(f.size > 0)) return {};
  if (scaling == Scaling::axis) return {};
  std::vector<double> out{f.spread[1] / f.spread[0] * steps, f.spread[2] / f.spread[0] * steps};
  if (scaling == Scaling::none) out.push_back(f.size / (8 * tolerance + 1e-9));
  return out;
}

std::vector<std::uint64_t> cells_of(const MeshForm& form, Scaling scaling, double tolerance, bool all) {
  std::vector<std::uint64_t> out{form.exact_key()};
  for (double v : invariants(form, scaling, tolerance)) {
    const double down = std::floor(v);
    const std::size_t n = out.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (all)
        out.push_back(
            mixed(out[i], static_cast<std::uint64_t>(static_cast<std::int64_t>(v - down < 0.5 ? down - 1 : down + 1))));
      out[i] = mixed(out[i], static_cast<std::uint64_t>(static_cast<std::int64_t>(down)));
    }
  }
  return out;
}

}  // namespace wrlkit::instancing
