// The nearest point of a surface among those triangles that have a label, such as a colour.
#pragma once
#include <optional>

#include "geometry/closest_point.h"

namespace wrlkit {

class ClosestOfLabel {
 public:
  static constexpr std::uint32_t no_label = 0xffffffffu;

  /// A label below `n_labels` for each triangle; those with others are not found. O(n log n), 28 bytes a triangle.
  /// The arrays must outlive this.
  ClosestOfLabel(Triangles surface, std::span<const std::uint32_t> labels, std::uint32_t n_labels);
  ClosestOfLabel(const ClosestOfLabel&) = delete;
  ClosestOfLabel& operator=(const ClosestOfLabel&) = delete;

  std::uint32_t n_labels() const { return static_cast<std::uint32_t>(of_label_.size()); }
  std::uint32_t label(std::uint32_t triangle) const { return labels_[triangle]; }
  /// As ClosestPoint::nearest, with numbers of triangles of the surface; infinite when none has the label. A guess of
  /// another label is none.
  ClosestPoint::Nearest nearest(const Vec3& p, const Vec3& facing, std::uint32_t label,
                                std::uint32_t guess = ClosestPoint::no_guess, double enough = -1) const;
  /// Among all triangles of other labels.
  double distance_of_others(const Vec3& p, std::uint32_t label) const;

 private:
  struct Part {
    std::vector<std::uint32_t> triangles, corners;
    std::optional<ClosestPoint> nearest;
    Box box;
  };

  std::span<const std::uint32_t> labels_;
  std::vector<std::uint32_t> place_;  // of each triangle among those of its label
  std::vector<Part> of_label_;
};

}  // namespace wrlkit
