// Pieces of a surface.
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace wrlkit::bake {

/// By point: the least point of those that triangles connect with it. `corners` are points, three a triangle; there
/// are as many points as the largest number among them says.
inline std::vector<std::uint32_t> connected(std::span<const std::uint32_t> corners) {
  std::vector<std::uint32_t> root(corners.empty() ? 0 : *std::ranges::max_element(corners) + std::size_t{1});
  std::iota(root.begin(), root.end(), 0u);
  auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (std::size_t c = 0; c + 2 < corners.size(); c += 3)
    for (std::size_t k = 1; k < 3; ++k) {
      const auto a = find(corners[c]), b = find(corners[c + k]);
      root[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = find(i);
  return root;
}

}  // namespace wrlkit::bake
