// Where the surfaces of a scene are shown, when some of very many places will do.
#pragma once
#include "geometry/simplify/surfaces.h"
#include "scenegraph/places/times_shown.h"

namespace wrlkit::simplify {

/// How often the nodes of a scene are shown.
struct ShownTimes {
  explicit ShownTimes(const Scene& scene);

  std::uint64_t of(const ShapeSurface& surface) const;  // saturates

  std::vector<NodeId> nodes;         // shown_nodes
  std::vector<std::uint64_t> times;  // times_shown
};

/// The places of each surface, to the world, in the order of the file. Of a surface that has more than `most` places,
/// that many are given, spread evenly over them; of surfaces that are always shown together the same ones. `most` is
/// from 1 to below 2^32. O(nodes + places given * log(times shown)), and up to most_visits other places.
std::vector<std::vector<Matrix>> some_places(const Scene& scene, const ShownTimes& shown,
                                             std::span<const ShapeSurface> surfaces, std::uint64_t most);

}  // namespace wrlkit::simplify
