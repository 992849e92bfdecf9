// Colours of VRML and of pictures are display-referred (IEC 61966-2-1, sRGB); light adds up in linear numbers.
#pragma once
#include <algorithm>
#include <cmath>

namespace wrlkit {

inline double srgb_to_linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

/// Into [0, 1]; what is no number is black.
inline double linear_to_srgb(double v) {
  v = v > 0 ? std::min(v, 1.0) : 0;
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace wrlkit
