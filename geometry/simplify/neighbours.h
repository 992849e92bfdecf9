// What else there is around a part of a scene: how far away the nearest other part is.
#pragma once
#include <optional>
#include <vector>

#include "base/math/matrix.h"
#include "geometry/closest_point.h"

namespace wrlkit::simplify {

/// Parts are ranges of owners. A part that makes up a good share of all triangles (thousands of bolts) has a tree of
/// its own: asked for what is nearest but for that part, the others are found as if it were not there.
class Neighbours {
 public:
  struct Found {
    double distance;      // infinite: there is none
    std::uint32_t owner;  // then ClosestPoint::no_guess
    std::uint32_t triangle;
  };

  /// Triangles of a surface in a place, which belong to an owner, by ascending owners; the faces are numbers of
  /// triangles.
  void add(const Triangles& surface, std::span<const std::uint32_t> faces, const Matrix& place, std::uint32_t owner);
  /// All owners since the last call, or the first, are one part.
  void end_part();
  /// After the last was added, before the first question. O(n log n).
  void prepare();

  /// A part, with the owners from `first` to before `end`, leaves. O(n log n) for all together; numbers of triangles
  /// may change.
  void leave(std::uint32_t first, std::uint32_t end);
  bool is_left(std::uint32_t owner) const { return left_[owner] != 0; }

  /// Of the triangles of the owners that count. `guess`: a triangle that is near. Any number of threads may ask.
  Found nearest(const Vec3& p, double within, const ClosestPoint::Counting& counts,
                std::uint32_t guess = ClosestPoint::no_guess) const;
  std::array<Vec3, 3> corners(std::uint32_t triangle) const { return Triangles{positions_, corners_}[triangle]; }

 private:
  /// Triangles behind one another, of ascending owners.
  struct Range {
    std::uint32_t begin, end;
    std::size_t n_gone = 0;
    std::optional<ClosestPoint> tree{};
  };
  void make_tree(Range& range) const;
  bool counts_in(const Range& range, const ClosestPoint::Counting& counts) const;
  void compact(Range& range);

  std::vector<double> positions_;
  std::vector<std::uint32_t> corners_, owner_;
  std::vector<char> left_;                // whether each owner is still there
  std::vector<std::uint32_t> part_ends_;  // numbers of triangles
  StampedMap slot_;
  std::vector<Range> ranges_;
};

}  // namespace wrlkit::simplify
