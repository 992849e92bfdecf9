// The surfaces of pieces as one list of triangles.
#pragma once
#include <cstdint>
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
  Triangles triangles() const { return {positions, corners}; }
};

}  // namespace wrlkit::tiles
