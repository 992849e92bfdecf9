// Where a mesh stands, as a key: what stands twice in one place is put before the rays once.
#pragma once
#include <array>
#include <cstdint>
#include <functional>

#include "base/hashing.h"
#include "light/render/linear.h"

namespace wrlkit::drawing {

/// A mesh in a frame. Forty doublings of a Group in place would be a million shapes that every ray has to try.
struct Placement {
  std::uint32_t mesh;
  Affine frame;

  std::array<double, 13> key() const {
    const Affine& f = frame;
    return {
        f.x.x, f.x.y, f.x.z, f.y.x, f.y.y, f.y.z, f.z.x, f.z.y, f.z.z, f.t.x, f.t.y, f.t.z, static_cast<double>(mesh)};
  }
  bool operator==(const Placement& o) const { return key() == o.key(); }
};
struct PlacementHash {
  std::size_t operator()(const Placement& p) const {
    std::uint64_t h = 0;
    for (double v : p.key()) h = mixed(h, std::hash<double>()(v));
    return h;
  }
};

}  // namespace wrlkit::drawing
