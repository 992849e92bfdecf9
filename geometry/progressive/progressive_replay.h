// What writer and reader of a progressive stream both know of the mesh as far as it has come: where its vertices are,
// and the corners of each vertex by ascending number. A split names corners by their place among those (the fan), which
// are few.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/progressive/position_code.h"
#include "geometry/progressive/progressive.h"

namespace wrlkit::simplify {

/// The first byte of a split.
namespace split_bits {
constexpr std::uint8_t n_faces = 3;  // 3: and more, whose number follows
constexpr std::uint8_t moves = 4;    // the vertex that is split
constexpr std::uint8_t better = 8;   // the error falls
constexpr std::uint8_t wedges = 16;  // the wedges of the corners that go are listed one by one
constexpr std::uint8_t values = 32;  // wedges that stay get other values
}  // namespace split_bits

namespace mesh_bits {
constexpr std::uint8_t ccw = 1, solid = 2, convex = 4, normal = 8, color = 16, alpha = 32, texcoord = 64;
}

constexpr std::string_view progressive_magic = "WPM1";

class Replay {
 public:
  using Corner = ProgressiveRecord::Corner;
  using Point = ProgressiveRecord::Point;
  static constexpr std::uint32_t none = 0xffffffffu;

  void add_vertex(const Point& p) {
    position.push_back(p);
    first_.push_back(none);
    last_.push_back(none);
  }
  void add_face(const std::array<Corner, 3>& corners) {
    for (const Corner& c : corners) {
      corner.push_back(c);
      next_.push_back(none);
      append(c.vertex, static_cast<std::uint32_t>(corner.size() - 1));
    }
  }
  /// The corners of a vertex, which has none any more; `append` gives them back, by ascending number.
  void take_fan(std::uint32_t vertex, std::vector<std::uint32_t>& fan) {
    fan.clear();
    for (std::uint32_t c = first_[vertex]; c != none; c = next_[c]) fan.push_back(c);
    first_[vertex] = last_[vertex] = none;
  }
  void append(std::uint32_t vertex, std::uint32_t c) {
    (first_[vertex] == none ? first_[vertex] : next_[last_[vertex]]) = c;
    last_[vertex] = c;
    next_[c] = none;
  }
  /// One of the two neighbours of a corner in its face: 0 the next, 1 the one before.
  static std::uint32_t neighbour(std::uint32_t c, std::uint32_t side) { return c - c % 3 + (c % 3 + 1 + side) % 3; }
  /// Where the vertex that a split makes is expected: opposite to where the other one goes, seen from where both were.
  static double opposite(double both, double other) { return 2 * both - other; }

  std::vector<Point> position;
  std::vector<Corner> corner;
  std::vector<std::uint32_t> row;  // of each wedge

 private:
  std::vector<std::uint32_t> first_, last_;  // corner of each vertex
  std::vector<std::uint32_t> next_;          // corner of the same vertex
};

}  // namespace wrlkit::simplify
