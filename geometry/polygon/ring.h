// Corners of polygons as rings of nodes in the plane. Several nodes may be of one point: where a hole is joined to its
// outline by a bridge, both ends of the bridge are there twice.
#pragma once
#include <cstdint>
#include <vector>

#include "geometry/polygon/orientation.h"

namespace wrlkit {

struct Rings {
  struct Node {
    std::uint32_t before, after;
    std::uint32_t point;  // index of the caller's
  };
  std::vector<Node> nodes;
  std::vector<Vec2> at;  // per node

  void clear() {
    nodes.clear();
    at.clear();
  }

  std::uint32_t add(std::uint32_t point, const Vec2& where) {
    auto n = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back({n, n, point});
    at.push_back(where);
    return n;
  }
  void link(std::uint32_t a, std::uint32_t b) {
    nodes[a].after = b;
    nodes[b].before = a;
  }

  std::uint32_t before(std::uint32_t n) const { return nodes[n].before; }
  std::uint32_t after(std::uint32_t n) const { return nodes[n].after; }

  /// Twice the area of the triangle of a node and its neighbours: positive where a ring that runs anticlockwise is
  /// convex.
  double turn(std::uint32_t n) const { return orientation(at[before(n)], at[n], at[after(n)]); }
};

}  // namespace wrlkit
