// The nearest point of a surface of triangles: a tree of boxes (bounding volume hierarchy) over views of a caller's
// arrays.
//
// Embree's point query was measured against it (docs/performance.md): the tree here is built faster for the small parts
// that plants are made of, asks in double, and gives the same triangle for any number of threads.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh.h"
#include "scenegraph/value.h"

namespace wrlkit {

/// A view of triangles: for each corner the index of its position, three corners a triangle. The front is where the
/// corners run counter-clockwise.
struct Triangles {
  std::span<const double> positions;  // xyz
  std::span<const std::uint32_t> corners;

  std::size_t size() const { return corners.size() / 3; }
  std::array<Vec3, 3> operator[](std::size_t triangle) const {
    return {position(corners[triangle * 3]), position(corners[triangle * 3 + 1]), position(corners[triangle * 3 + 2])};
  }
  Vec3 position(std::uint32_t i) const {
    const double* p = positions.data() + std::size_t{i} * 3;
    return {p[0], p[1], p[2]};
  }
};

/// A view of a mesh of triangles (Mesh::is_triangles), which must outlive the view; no triangles otherwise.
Triangles triangles_of(const Mesh& mesh);

/// Perpendicular to a triangle on its front, as long as twice its area.
Vec3 area_normal(const std::array<Vec3, 3>& corners);

/// Squared distance of a point from a triangle.
double squared_distance(const Vec3& p, const std::array<Vec3, 3>& corners);

/// Where single precision and sums of squares are safe. A triangle with a corner beyond, or not finite, is not
/// part of a surface.
bool is_usable(const std::array<Vec3, 3>& corners);

class ClosestPoint {
 public:
  struct Nearest {
    double distance;  // infinite when the surface has no usable triangle
    std::uint32_t triangle;
    std::uint32_t n_tried = 0;  // triangles: what the question cost
  };

  /// O(n log n), 24 bytes a triangle. The arrays that `surface` looks at must outlive this.
  explicit ClosestPoint(Triangles surface);
  /// The same of triangles with labels, ascending, by which some may be left out of a question. 48 bytes a triangle.
  ClosestPoint(Triangles surface, std::span<const std::uint32_t> labels);

  /// Where `p` is nearest to the surface, usually O(log n). On an edge or a corner several triangles are equally
  /// near: the one whose front faces most nearly along `facing` is given (of the first 32). `guess` is a triangle of
  /// which it is known that it is near: the answer for the point before; it makes the search shorter. So does `enough`:
  /// any triangle within that distance is an answer. Any number of threads may ask.
  Nearest nearest(const Vec3& p, const Vec3& facing, std::uint32_t guess = no_guess, double enough = -1) const;

  /// Labels that count: all but those from `first` to before `end`, and those that are 0 in `left`, if that is given.
  struct Counting {
    std::uint32_t first = 0, end = 0;
    std::span<const char> left = {};
    bool operator()(std::uint32_t label) const {
      return (label < first || label >= end) && (left.empty() || left[label] != 0);
    }
  };
  /// The same among the triangles whose labels count, within a distance; infinite when there is none. Where neighbours
  /// have labels near one another, those that do not count are passed over together. `guess` as above. Where thousands
  /// are about equally near, the nearest of the first 20,000 that are tried.
  Nearest nearest_of(const Vec3& p, double within, const Counting& counts, std::uint32_t guess = no_guess) const;

  /// Triangles with labels from `first` to before `end` will not be found again, nor cost anything. O(log n) for each
  /// of them, mostly O(1).
  void forget(std::uint32_t first, std::uint32_t end);

  static constexpr std::uint32_t no_guess = 0xffffffffu;

 private:
  /// Children are next to each other only by depth-first order: the left one follows, the right one is `next`. A leaf
  /// has its triangles at order_[next] and on.
  struct Box {
    std::array<float, 3> low, high;
    std::uint32_t next, n_triangles;
  };
  struct Builder;
  struct Search;

  static constexpr std::uint32_t none = 0xffffffffu;
  /// Empty when `least` is above `most`.
  struct Labels {
    std::uint32_t least = none, most = 0;
    void add(const Labels& o) {
      least = o.least < least ? o.least : least;
      most = o.most > most ? o.most : most;
    }
    bool operator==(const Labels&) const = default;
  };
  Labels labels_in(std::uint32_t box) const;

  Triangles surface_;
  std::span<const std::uint32_t> labels_;
  std::vector<Labels> box_labels_;
  std::vector<std::uint32_t> parent_, leaf_of_;  // of each box, of each triangle; only where there are labels
  Vec3 centre_{};                                // boxes are relative to it
  double same_ = 0;                              // distances that differ by less are equal
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> order_;
};

}  // namespace wrlkit
