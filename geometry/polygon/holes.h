// Polygons with holes as one ring: each hole is joined to the outline by a bridge, two edges there and back.
#pragma once
#include <span>

#include "geometry/polygon/ring.h"

namespace wrlkit {

/// Joins the holes, which run clockwise, to the ring that `outline` is in, which runs anticlockwise; `holes` has a node
/// of each. A hole that does not lie inside is left alone. O(nodes) for each hole.
void join_holes(Rings& rings, std::uint32_t outline, std::span<const std::uint32_t> holes);

}  // namespace wrlkit
