// Which edges lie on each other: the table behind all questions about how faces hang together.
#pragma once
#include <cstdint>
#include <vector>

#include "passes/weld/surface.h"

namespace wrlkit {

/// An edge of the surface and the corners from which faces run along it, to the next of their corners. An edge with
/// both ends at one point is none.
struct SurfaceEdge {
  std::uint32_t first, second;  // the first two such corners; `second` is meaningless when there is one
  std::uint32_t n_faces;

  bool open() const { return n_faces == 1; }
  bool manifold() const { return n_faces == 2; }
};

class EdgeTable {
 public:
  /// Finds the edges of a surface, whose face_of is filled. Linear in the corners, without hashing or sorting, also
  /// where one point has very many edges.
  void build(const Surface&);
  const std::vector<SurfaceEdge>& edges() const { return edges_; }

 private:
  struct Link {
    std::uint32_t high, next;
  };
  struct Seen {
    std::uint32_t low, edge;
  };

  std::vector<std::uint32_t> first_;  // corner, by the lower point of its edge
  std::vector<Link> links_;           // by corner: the higher point of its edge, and the next corner in the chain
  std::vector<Seen> seen_;            // by higher point: the last edge that ended there
  std::vector<SurfaceEdge> edges_;
};

/// How many points there are at which faces meet that hang together by no manifold edge there. `parents` and `fans` are
/// working memory.
std::size_t count_non_manifold_points(const Surface&, const std::vector<SurfaceEdge>&,
                                      std::vector<std::uint32_t>& parents, std::vector<std::uint32_t>& fans);

}  // namespace wrlkit
