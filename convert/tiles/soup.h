// The surfaces of pieces as one list of triangles.
#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "convert/tiles/piece.h"
#include "geometry/closest_point.h"

namespace wrlkit::tiles {

/// Around an origin, in metres. Lines and points are left out.
struct Soup {
  std::vector<double> positions;
  std::vector<std::uint32_t> corners;

  Soup(std::span<const Piece> pieces, const Vec3& origin) {
    for (const auto& p : pieces) {
      if (!p.mesh.is_triangles()) continue;
      const auto first = static_cast<std::uint32_t>(positions.size() / 3);
      const auto from = p.mesh.positions.span();
      for (std::size_t i = 0; i < from.size(); ++i) positions.push_back(from[i] - origin[i % 3]);
      for (const auto c : p.mesh.corners) corners.push_back(first + c);
    }
  }
  /// Of triangles that are asked for, by a piece and the number of one of its triangles.
  using Takes = std::function<bool(const Piece& piece, std::size_t triangle)>;
  Soup(std::span<const Piece> pieces, const Vec3& origin, const Takes& takes) {
    constexpr std::uint32_t none = 0xffffffffu;
    std::vector<std::uint32_t> number;
    for (const auto& p : pieces) {
      if (!p.mesh.is_triangles()) continue;
      number.assign(p.mesh.n_positions(), none);
      for (std::size_t i = 0; i < p.mesh.corners.size(); ++i) {
        if (!takes(p, i / 3)) continue;
        auto& n = number[p.mesh.corners[i]];
        if (n == none) {
          n = static_cast<std::uint32_t>(positions.size() / 3);
          const Vec3 at = p.mesh.position(p.mesh.corners[i]) - origin;
          positions.insert(positions.end(), at.begin(), at.end());
        }
        corners.push_back(n);
      }
    }
  }
  Triangles triangles() const { return {positions, corners}; }
};

}  // namespace wrlkit::tiles
