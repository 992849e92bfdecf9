#include "writers/gltf/document/levels.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::gltf {
namespace {

/// The part of the window's height down to which each level is shown.
std::vector<double> screen_coverage(std::span<const double> range, double radius, double scale, std::size_t n_levels) {
  constexpr double half_field_of_view = 0.785398 / 2;
  std::vector<double> out;
  if (range.empty() || !(radius > 0) || !(scale > 0)) return out;
  double last = 1;
  for (std::size_t i = 0; i + 1 < n_levels; ++i) {
    const double d = i < range.size() ? range[i] * scale : 0;
    const double covered = d > 0 ? radius / (d * std::tan(half_field_of_view)) : 1;
    last = std::min(last, covered);
    out.push_back(last);
  }
  out.push_back(0);
  return out;
}

}  // namespace

void make_levels(Document& d, std::span<const std::uint32_t> levels, std::span<const double> range, double radius,
                 double scale) {
  d.nodes[levels[0]].lod = true;
  d.lods.emplace(levels[0],
                 Lod{{levels.begin() + 1, levels.end()}, screen_coverage(range, radius, scale, levels.size())});
}

}  // namespace wrlkit::gltf
