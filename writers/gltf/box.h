// Axis-parallel box in world coordinates; empty when nothing was added.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "scenegraph/value.h"

namespace wrlkit::gltf {

struct Box {
  static constexpr double inf = std::numeric_limits<double>::infinity();
  Vec3 low{inf, inf, inf}, high{-inf, -inf, -inf};

  bool empty() const { return !(low[0] <= high[0]); }
  void add(const Box& b) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], b.low[i]);
      high[i] = std::max(high[i], b.high[i]);
    }
  }
  Vec3 centre() const { return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}; }
  /// Length of the diagonal.
  double extent() const { return empty() ? 0 : std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]); }
  /// The largest coordinate, without its sign.
  double reach() const {
    double r = 0;
    for (std::size_t i = 0; i < 3 && !empty(); ++i) r = std::max({r, std::abs(low[i]), std::abs(high[i])});
    return r;
  }
};

inline double distance(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

}  // namespace wrlkit::gltf
