#include "geometry/simplify/pieces.h"

#include <algorithm>
#include <numeric>

namespace wrlkit::simplify {
namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

}  // namespace

std::vector<std::vector<std::uint32_t>> connected_pieces(const Mesh& mesh) {
  std::vector<std::uint32_t> root(mesh.n_positions());
  std::iota(root.begin(), root.end(), 0u);
  auto find = [&](std::uint32_t v) {
    while (root[v] != v) {
      root[v] = root[root[v]];
      v = root[v];
    }
    return v;
  };
  for (std::size_t i = 0; i + 2 < mesh.corners.size(); i += 3)
    for (std::size_t k = 1; k < 3; ++k) root[find(mesh.corners[i + k])] = find(mesh.corners[i]);
  std::vector<std::uint32_t> number(mesh.n_positions(), nobody);
  std::vector<std::vector<std::uint32_t>> out;
  for (std::uint32_t f = 0; f < mesh.n_faces(); ++f) {
    auto& n = number[find(mesh.corners[std::size_t{3} * f])];
    if (n == nobody) {
      n = static_cast<std::uint32_t>(out.size());
      out.emplace_back();
    }
    out[n].push_back(f);
  }
  return out;
}

Mesh piece_of(const Mesh& mesh, std::span<const std::uint32_t> faces, std::vector<std::uint32_t>& original) {
  Mesh out;
  out.kind = Mesh::Kind::faces;
  out.ccw = mesh.ccw;
  out.solid = mesh.solid;
  out.crease_angle = mesh.crease_angle;
  original.clear();
  for (auto f : faces)
    for (std::size_t k = 0; k < 3; ++k) original.push_back(mesh.corners[std::size_t{3} * f + k]);
  std::ranges::sort(original);
  original.erase(std::unique(original.begin(), original.end()), original.end());
  auto& positions = out.positions.edit();
  for (auto p : original)
    positions.insert(positions.end(), mesh.positions.data() + std::size_t{3} * p,
                     mesh.positions.data() + std::size_t{3} * p + 3);
  const auto from = mesh.attributes();
  const auto to = out.attributes();
  for (auto f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto c = std::size_t{3} * f + k;
      const auto place = std::ranges::lower_bound(original, mesh.corners[c]);
      out.corners.push_back(static_cast<std::uint32_t>(place - original.begin()));
      for (std::size_t a = 0; a < from.size(); ++a) {
        if (!from[a]->present()) continue;
        to[a]->width = from[a]->width;
        to[a]->index.push_back(static_cast<std::uint32_t>(to[a]->count()));
        const float* v = from[a]->at(from[a]->index[c]);
        to[a]->values.insert(to[a]->values.end(), v, v + from[a]->width);
      }
    }
  return out;
}

void append(Mesh& to, const Mesh& from) {
  const auto base = static_cast<std::uint32_t>(to.n_positions());
  const bool first = to.corners.empty();
  auto& positions = to.positions.edit();
  positions.insert(positions.end(), from.positions.data(), from.positions.data() + from.positions.size());
  for (auto c : from.corners) to.corners.push_back(base + c);
  const auto a = to.attributes();
  const auto b = from.attributes();
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!b[i]->present() || (!first && !a[i]->present())) {
      a[i]->clear();
      continue;
    }
    const auto begin = static_cast<std::uint32_t>(first ? 0 : a[i]->count());
    a[i]->width = b[i]->width;
    a[i]->values.insert(a[i]->values.end(), b[i]->values.begin(), b[i]->values.end());
    for (auto index : b[i]->index) a[i]->index.push_back(begin + index);
  }
}

void transform(Mesh& mesh, const Matrix& m) {
  auto& p = mesh.positions.edit();
  for (std::size_t i = 0; i + 2 < p.size(); i += 3) {
    const Vec3 q = m.point({p[i], p[i + 1], p[i + 2]});
    std::copy(q.begin(), q.end(), p.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace wrlkit::simplify
