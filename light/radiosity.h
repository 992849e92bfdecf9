// Fills the cache: finds where light goes from the points that are asked for, and solves for what it brings there after
// any number of reflections.
#pragma once
#include <span>

#include "light/transport.h"

namespace wrlkit::light {

/// Walks from the receivers find the cells; rays from each find what it gathers from each other one (links.h). Costs a
/// sixteenth of `work`, the rays that will look cells up, between 128 and 2,048 rays a cell; 64 at least for points of
/// fewer than 16 `rays`, whose own noise hides that of the cells.
void fill(IrradianceCache& cache, const LightWorld& world, const DirectLight& direct, std::span<const Receiver> from,
          int rays, double work, std::uint64_t seed);

}  // namespace wrlkit::light
