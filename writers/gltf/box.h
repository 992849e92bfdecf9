// What the glTF writer asks of boxes in world coordinates.
#pragma once
#include "base/math/box.h"

namespace wrlkit::gltf {

/// The largest coordinate, without its sign.
inline double reach(const Box& b) {
  double r = 0;
  for (std::size_t i = 0; i < 3 && !b.empty(); ++i) r = std::max({r, std::abs(b.low[i]), std::abs(b.high[i])});
  return r;
}

}  // namespace wrlkit::gltf
