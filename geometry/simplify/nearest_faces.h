// Many points against a few triangles, all with all: the inner loop of fitting.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/math/vec.h"

namespace wrlkit::simplify {

/// Points with the nearest of some triangles. Single precision: relative to an origin near them.
struct PointBatch {
  Vec3 origin{};
  std::size_t n = 0;
  std::vector<float> x, y, z;       // with room for whole vectors
  std::vector<float> squared;       // distance; infinite before the first triangle
  std::vector<std::int32_t> face;   // number of the triangle
  std::vector<std::int32_t> label;  // of the points of coloured surfaces
  std::vector<float> penalty;       // squared distance that a triangle of another label is farther

  void reset(const Vec3& new_origin);
  void add(const Vec3& p);
  void add(const Vec3& p, std::uint32_t label_of_p, double penalty_of_p);
};

/// Sets `squared` and `face` of the first `n` points. Of equally near triangles the first is taken. With `labels` of
/// the faces, points have been added with theirs. O(n * faces), by vector instructions.
void nearest_faces(std::span<const std::array<Vec3, 3>> faces, std::size_t n, PointBatch& points,
                   std::span<const std::uint32_t> labels = {});

}  // namespace wrlkit::simplify
