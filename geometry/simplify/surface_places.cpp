#include "geometry/simplify/surface_places.h"

#include <algorithm>
#include <optional>

#include "base/math/saturating.h"
#include "geometry/simplify/surface_scales.h"
#include "scenegraph/places/places.h"

namespace wrlkit::simplify {
namespace {

/// The k-th of `some` numbers spread evenly over those below `n`. Both are at least 1, `some` is below 2^32.
std::uint64_t spread(std::uint64_t k, std::uint64_t some, std::uint64_t n) {
  return k * (n / some) + k * (n % some) / some;
}

Matrix place_of(const NumberedPlaces& numbered, const ShownTimes& shown, const ShapeSurface& surface,
                std::uint64_t number) {
  for (NodeId shape : surface.shapes) {
    const auto times = shown.times[shape.value];
    if (number < times) return numbered.place(shape, number);
    number -= times;
  }
  return {};
}

}  // namespace

ShownTimes::ShownTimes(const Scene& scene) : nodes(shown_nodes(scene)), times(times_shown(scene, nodes)) {}

std::uint64_t ShownTimes::of(const ShapeSurface& surface) const {
  std::uint64_t n = 0;
  for (NodeId shape : surface.shapes) n = saturating_add(n, times[shape.value]);
  return n;
}

std::vector<std::vector<Matrix>> some_places(const Scene& scene, const ShownTimes& shown,
                                             std::span<const ShapeSurface> surfaces, std::uint64_t most) {
  std::vector<std::vector<Matrix>> out(surfaces.size());
  std::vector<std::uint64_t> n(surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) n[i] = shown.of(surfaces[i]);
  std::uint64_t n_ways = 0;
  for (const auto times : shown.times) n_ways = saturating_add(n_ways, times);
  const bool can_follow = n_ways <= most_visits;
  const auto number = surface_numbers(scene, surfaces);
  if (can_follow)
    for_each_place(scene, Shown::now, [&](NodeId shape, const Matrix& m) {
      if (const auto i = number[shape.value]; i && n[i - 1] <= most) out[i - 1].push_back(m);
    });
  std::optional<NumberedPlaces> numbered;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (n[i] <= most && can_follow) continue;
    if (!numbered) numbered.emplace(scene, shown.nodes, shown.times);
    const auto some = std::min(n[i], most);
    for (std::uint64_t k = 0; k < some; ++k)
      out[i].push_back(place_of(*numbered, shown, surfaces[i], spread(k, some, n[i])));
  }
  return out;
}

}  // namespace wrlkit::simplify
