// How far quantisation may move a vertex.
#pragma once
#include <algorithm>
#include <cmath>

#include "writers/gltf/gltf.h"

namespace wrlkit::gltf {

/// In metres, of what is that large: what the options say; otherwise a millimetre, or less where that is much.
inline double tolerance_for(const GltfCompression& options, double extent) {
  constexpr double usual = 1e-3, usual_part = 8192;
  if (options.tolerance > 0) return options.tolerance;
  return extent > 0 && std::isfinite(extent) ? std::min(usual, extent / usual_part) : usual;
}

}  // namespace wrlkit::gltf
