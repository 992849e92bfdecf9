// Which edges of a surface are features: borders, creases, seams, and edges that are no inner edges of a manifold.
#pragma once
#include "geometry/simplify/surface.h"
#include "geometry/simplify/wedges.h"

namespace wrlkit::simplify {

struct FeatureOptions {
  bool borders, creases;
  double crease_angle;                   // radians
  std::span<const std::uint32_t> fixed;  // positions of the mesh that came in, ascending
};

/// Sets the features of the faces and the kinds of the vertices.
void find_features(Surface& surface, const Wedges& wedges, const FeatureOptions& options);

}  // namespace wrlkit::simplify
