#include "geometry/closest_of_label.h"

#include <algorithm>
#include <limits>

#include "base/math/vec.h"

namespace wrlkit {
namespace {

double squared_distance(const Vec3& p, const Box& box) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = std::max({box.low[i] - p[i], p[i] - box.high[i], 0.});
    sum += d * d;
  }
  return sum;
}

}  // namespace

ClosestOfLabel::ClosestOfLabel(Triangles surface, std::span<const std::uint32_t> labels, std::uint32_t n_labels)
    : labels_(labels), place_(surface.size()), of_label_(n_labels) {
  for (std::uint32_t t = 0; t < surface.size(); ++t) {
    if (labels[t] >= n_labels) continue;
    auto& part = of_label_[labels[t]];
    place_[t] = static_cast<std::uint32_t>(part.triangles.size());
    part.triangles.push_back(t);
    for (std::size_t k = 0; k < 3; ++k) part.corners.push_back(surface.corners[std::size_t{3} * t + k]);
    if (const auto corners = surface[t]; is_usable(corners))
      for (const Vec3& p : corners) part.box.add(p);
  }
  for (auto& part : of_label_) part.nearest.emplace(Triangles{surface.positions, part.corners});
}

ClosestPoint::Nearest ClosestOfLabel::nearest(const Vec3& p, const Vec3& facing, std::uint32_t label,
                                              std::uint32_t guess, double enough) const {
  if (label >= of_label_.size()) return {std::numeric_limits<double>::infinity(), ClosestPoint::no_guess};
  const auto& part = of_label_[label];
  const bool knows = guess != ClosestPoint::no_guess && labels_[guess] == label;
  auto found = part.nearest->nearest(p, facing, knows ? place_[guess] : ClosestPoint::no_guess, enough);
  if (found.triangle != ClosestPoint::no_guess) found.triangle = part.triangles[found.triangle];
  return found;
}

double ClosestOfLabel::distance_of_others(const Vec3& p, std::uint32_t label) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t other = 0; other < of_label_.size(); ++other) {
    const auto& part = of_label_[other];
    if (other == label || part.box.empty() || squared_distance(p, part.box) >= least * least) continue;
    least = std::min(least, part.nearest->nearest(p, {}).distance);
  }
  return least;
}

}  // namespace wrlkit
