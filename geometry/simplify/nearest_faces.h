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
  std::vector<float> x, y, z;      // with room for whole vectors
  std::vector<float> squared;      // distance; infinite before the first triangle
  std::vector<std::int32_t> face;  // number of the triangle

  void reset(const Vec3& new_origin);
  void add(const Vec3& p);
};

/// Sets `squared` and `face` of the first `n` points. Of equally near triangles the first is taken. O(n * faces), by
/// vector instructions.
void nearest_faces(std::span<const std::array<Vec3, 3>> faces, std::size_t n, PointBatch& points);

}  // namespace wrlkit::simplify
