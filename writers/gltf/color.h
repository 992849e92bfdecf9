// VRML's colours are meant for the display (IEC 61966-2-1), glTF's are linear.
#pragma once
#include <array>

#include "base/image/srgb.h"
#include "scenegraph/value.h"

namespace wrlkit::gltf {

/// Cut to [0, 1]; 0 when it is not a number.
inline double unit_range(double v) { return v >= 0 ? std::min(v, 1.0) : 0.0; }

inline double linear(double v) { return srgb_to_linear(unit_range(v)); }

inline std::array<float, 3> linear_color(const Vec3& c) {
  return {static_cast<float>(linear(c[0])), static_cast<float>(linear(c[1])), static_cast<float>(linear(c[2]))};
}

}  // namespace wrlkit::gltf
