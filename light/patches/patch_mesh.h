// Triangles that are cut into patches by bisecting longest edges (Rivara 1984): no angle gets below half of the
// smallest one of its triangle, so needles become rounder and nothing becomes a sliver. An edge is cut on both of its
// sides, so that neighbours meet corner to corner, across the triangles of a surface as well.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "light/render/linear.h"

namespace wrlkit::light {

using drawing::V3;

/// Normal of a triangle, its length twice the area.
inline V3 across(const std::array<V3, 3>& t) { return cross(t[1] - t[0], t[2] - t[0]); }

class PatchMesh {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;

  struct Face {
    std::array<std::uint32_t, 3> corners;     // in the order of the triangle
    std::array<std::uint32_t, 3> neighbours;  // across the edge from corner i to the next; none: border
    std::uint32_t triangle;                   // that it is a piece of
  };

  /// Corners that are equal to the last bit are one. Edges of more than two triangles are borders. O(triangles).
  explicit PatchMesh(std::span<const std::array<V3, 3>> triangles);

  std::size_t n_triangles() const { return first_child_.size(); }
  /// As they were given.
  std::array<V3, 3> triangle(std::uint32_t t) const;
  double triangle_area(std::uint32_t t) const;
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<V3>& points() const { return points_; }
  std::array<V3, 3> corners(std::size_t face) const;
  double area(std::size_t face) const;
  /// Do two faces lie in planes that hardly differ, the same side up?
  bool flat(std::size_t a, std::size_t b) const;
  /// Length of its longest edge; 0 of a triangle with two corners in one place. Such a one is never split, as two of
  /// its edges are one.
  double longest(std::size_t face) const;

  /// Halves a face at its longest edge, after those neighbours that have a longer one there. The face keeps its number
  /// as one of the halves; new faces come behind the last. The same calls give the same mesh.
  void split(std::size_t face);
  /// The face of a triangle that a point of it lies in. O(log of its faces), as longest edges are halved in turn.
  std::uint32_t locate(std::uint32_t triangle, const V3& point) const;

  /// Splits until no face is larger; 0: any size will do. False when that takes more than `limit` faces; it ends there.
  bool split_to(double max_edge, double max_area, std::size_t limit);

 private:
  /// How a face was halved, on the way down from a triangle to its faces. A child is a face, or `cut` + another Cut.
  struct Cut {
    std::uint32_t begin, middle, apex;  // corners: the first half lies on the side of `begin`
    std::array<std::uint32_t, 2> children;
  };
  static constexpr std::uint32_t cut = 0x80000000u;
  struct Edge {
    double square;
    std::uint32_t low, high;  // corners; they decide between edges of one length, so that both sides choose the same
    auto operator<=>(const Edge&) const = default;
  };
  Edge edge(std::uint32_t face, int i) const;
  int longest_edge(std::uint32_t face) const;
  int side_of(std::uint32_t face, const Edge& e) const;
  bool is_collapsed(std::size_t face) const;
  void link();
  void bisect(std::uint32_t face, int side);
  std::uint32_t halve(std::uint32_t face, int side, std::uint32_t middle);
  void record_cut(std::uint32_t face, std::uint32_t second, const Cut& made);

  std::vector<V3> points_;
  std::vector<Face> faces_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;  // corners
  std::vector<Cut> cuts_;
  std::vector<std::uint32_t> first_child_;  // by triangle
  std::vector<std::uint32_t> child_at_;  // by face: where it is a child, 2 * Cut + 0 or 1; of a whole triangle `none`
  std::vector<std::uint32_t> path_;      // scratch
};

}  // namespace wrlkit::light
