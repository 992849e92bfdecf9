// Which face of a fitted surface each sample of the part is nearest to, with regions of one colour or without.
#include "geometry/simplify/closest_on_triangle.h"
#include "geometry/simplify/fitted_surface.h"

namespace wrlkit::simplify {

/// Of all samples to all faces.
void FittedSurface::assign_all() {
  std::vector<std::uint32_t> corners, number;
  std::vector<double> flat;
  for (const Vec3& p : position_) flat.insert(flat.end(), p.begin(), p.end());
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    samples_of_[f].clear();
    if (!alive_[f]) continue;
    number.push_back(f);
    corners.insert(corners.end(), face_[f].begin(), face_[f].end());
  }
  if (number.empty()) return;
  if (!region_.empty()) return assign_by_regions(flat);
  const ClosestPoint nearest(Triangles{flat, corners});
  auto guess = ClosestPoint::no_guess;
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    const auto found = nearest.nearest(samples_[s].point, {}, guess);
    guess = found.triangle;
    if (guess == ClosestPoint::no_guess) continue;
    squared_[s] = found.distance * found.distance;
    samples_of_[number[guess]].push_back(s);
  }
}

/// To the nearest face of the region of each, or to one of another region that is nearer nevertheless.
void FittedSurface::assign_by_regions(std::span<const double> positions) {
  std::vector<std::uint32_t> corners, number, regions;
  for (std::uint32_t f = 0; f < face_.size(); ++f) {
    if (!alive_[f]) continue;
    number.push_back(f);
    regions.push_back(region_[f]);
    corners.insert(corners.end(), face_[f].begin(), face_[f].end());
  }
  const Triangles all{positions, corners};
  const ClosestPoint nearest(all);
  const ClosestOfLabel of_region(all, regions, original_.regions->n_labels());
  auto guess = ClosestPoint::no_guess, own_guess = ClosestPoint::no_guess;
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    const auto& sample = samples_[s];
    const auto any = nearest.nearest(sample.point, {}, guess);
    if (any.triangle == ClosestPoint::no_guess) continue;
    guess = any.triangle;
    auto found = any.triangle;
    squared_[s] = any.distance * any.distance;
    if (regions[found] != sample.region) {
      const auto own = of_region.nearest(sample.point, {}, sample.region, own_guess);
      own_guess = own.triangle;
      squared_[s] += sample.squared_depth;
      if (own.distance * own.distance < squared_[s]) {
        squared_[s] = own.distance * own.distance;
        found = own.triangle;
      }
    }
    samples_of_[number[found]].push_back(s);
  }
}

/// Of the faces whose corners are listed.
void FittedSurface::list_regions(std::span<const std::uint32_t> faces) {
  regions_.clear();
  for (std::size_t i = 0; i < faces.size() && !region_.empty(); ++i) regions_.push_back(region_[faces[i]]);
}

void FittedSurface::add_point(std::uint32_t sample) {
  const auto& s = samples_[sample];
  region_.empty() ? points_.add(s.point) : points_.add(s.point, s.region, s.squared_depth);
}

}  // namespace wrlkit::simplify
