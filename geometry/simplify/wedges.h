// Attributes of the corners while vertices merge. A wedge is a vertex with one set of values (normal, color, texture
// coordinate); the corners of a vertex that agree share one. Where a vertex has more than one wedge, there is a seam.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/simplify/surface.h"

namespace wrlkit::simplify {

class Wedges {
 public:
  Wedges(const Mesh& mesh, const Surface& surface);

  bool present() const { return width_ > 0; }
  int width() const { return width_; }
  /// Floats of a wedge, in the order normal, color, texcoord, lightcoord.
  const float* at(std::uint32_t wedge) const { return values.data() + std::size_t{wedge} * width_; }
  float* at(std::uint32_t wedge) { return values.data() + std::size_t{wedge} * width_; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(width_ ? values.size() / width_ : 0); }

  /// Whether a seam runs between the two: another color or texture coordinate, or normals with less than `cosine`
  /// between.
  bool differ(std::uint32_t a, std::uint32_t b, double cosine) const;
  /// What lies at t from a (0) to b (1), into `out`. Normals stay of unit length.
  void interpolate(std::uint32_t a, std::uint32_t b, double t, float* out) const;

  /// Fills the attributes of `mesh`, whose corners are those of the living faces, in order.
  void write(Mesh& mesh, const Surface& surface) const;

  std::vector<std::array<std::uint32_t, 3>> of_face;  // empty without attributes
  std::vector<float> values;

 private:
  int n_normal_ = 0, n_color_ = 0, n_texcoord_ = 0, n_lightcoord_ = 0, width_ = 0;
};

}  // namespace wrlkit::simplify
