// Numbers of VRML are read as double; glTF's are single precision, and finite.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace wrlkit::gltf {

inline constexpr double largest_float = std::numeric_limits<float>::max();

/// False for what is not a number, too.
inline bool fits_float(double v) { return std::abs(v) <= largest_float; }
bool fits_float(const auto& values) {
  return std::ranges::all_of(values, [](double v) { return fits_float(v); });
}

/// The nearest float that is finite; v must be a number.
inline float to_float(double v) { return static_cast<float>(std::clamp(v, -largest_float, largest_float)); }

}  // namespace wrlkit::gltf
