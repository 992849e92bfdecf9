// The same form elsewhere: turned, larger, or a pipe that is longer.
#pragma once
#include <optional>

#include "base/math/matrix.h"
#include "geometry/closest_point.h"

namespace wrlkit::simplify {

/// Equal for meshes whose corners use their positions in the same order.
std::uint64_t hash_of_corners(const Mesh& mesh);

class LikeForm {
 public:
  /// Of a mesh of triangles.
  explicit LikeForm(Mesh mesh);

  /// The affine map that takes it to `other`, as far as files round: within two thousandths of the extent, and a
  /// twentieth of the thickness. Nothing when there is none, when it mirrors, or when it makes lengths grow more than
  /// twice as much in one direction as in another; nor when the points lie on a line. O(n).
  std::optional<Matrix> to(const Mesh& other) const;

 private:
  std::optional<Matrix> frame_of(const Triangles& surface) const;

  Mesh mesh_;
  std::array<std::uint32_t, 4> at_{};  // positions far from one another
  bool flat_ = false;
  std::optional<Matrix> back_;
};

}  // namespace wrlkit::simplify
