// Fills the cache: finds where light goes from the points that are asked for, and solves for what it brings there after
// any number of reflections.
#pragma once
#include <span>

#include "light/transport.h"

namespace wrlkit::light {

/// Walks from the receivers find the cells; then all cells gather from one another until they agree, with new
/// directions each time (stochastic iteration; Szirmay-Kalos 1999). Costs some 150 rays a cell, or 90 for points of
/// fewer than 16 `rays`, whose own noise hides that of the cells.
void fill(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, std::span<const Receiver> from,
          int rays, std::uint64_t seed);

}  // namespace wrlkit::light
