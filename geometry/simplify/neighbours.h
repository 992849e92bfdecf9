// What else there is around a part of a world: how far away the nearest other part is.
#pragma once
#include <optional>
#include <vector>

#include "base/math/matrix.h"
#include "geometry/closest_point.h"

namespace wrlkit::simplify {

class Neighbours {
 public:
  struct Found {
    double distance;      // infinite: there is none
    std::uint32_t owner;  // then ClosestPoint::no_guess
    std::uint32_t triangle;
  };

  /// Triangles of a surface in a place, which belong to somebody; the faces are numbers of triangles.
  void add(const Triangles& surface, std::span<const std::uint32_t> faces, const Matrix& place, std::uint32_t owner);
  /// After the last was added, before the first question. O(n log n).
  void prepare();

  /// Forgets the triangles of owners whose entry is 0. O(n log n) in those that are left.
  void keep(std::span<const char> left);

  std::size_t n_triangles() const { return owner_.size(); }
  std::uint32_t owner_of(std::uint32_t triangle) const { return owner_[triangle]; }
  /// Of the triangles of the owners that count. `guess`: a triangle that is near. Any number of threads may
  /// ask.
  Found nearest(const Vec3& p, double within, const ClosestPoint::Counting& counts,
                std::uint32_t guess = ClosestPoint::no_guess) const;
  std::array<Vec3, 3> corners(std::uint32_t triangle) const { return Triangles{positions_, corners_}[triangle]; }

 private:
  std::vector<double> positions_;
  std::vector<std::uint32_t> corners_, owner_;
  StampedMap slot_;
  std::optional<ClosestPoint> tree_;
};

}  // namespace wrlkit::simplify
