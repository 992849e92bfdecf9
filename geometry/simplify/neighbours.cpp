#include "geometry/simplify/neighbours.h"

namespace wrlkit::simplify {

void Neighbours::add(const Triangles& surface, std::span<const std::uint32_t> faces, const Matrix& place,
                     std::uint32_t owner) {
  slot_.reset(surface.positions.size() / 3);
  for (auto f : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto c = surface.corners[std::size_t{3} * f + k];
      if (!slot_.contains(c)) {
        slot_.set(c, static_cast<std::uint32_t>(positions_.size() / 3));
        const Vec3 p = place.point(surface.position(c));
        positions_.insert(positions_.end(), p.begin(), p.end());
      }
      corners_.push_back(slot_[c]);
    }
  owner_.insert(owner_.end(), faces.size(), owner);
}

void Neighbours::prepare() { tree_.emplace(Triangles{positions_, corners_}, owner_); }

void Neighbours::keep(std::span<const char> left) {
  tree_.reset();
  std::size_t n = 0;
  for (std::size_t t = 0; t < owner_.size(); ++t) {
    if (left[owner_[t]] == 0) continue;
    for (std::size_t k = 0; k < 3; ++k) corners_[3 * n + k] = corners_[3 * t + k];
    owner_[n++] = owner_[t];
  }
  corners_.resize(3 * n);
  owner_.resize(n);
  prepare();
}

Neighbours::Found Neighbours::nearest(const Vec3& p, double within, const ClosestPoint::Counting& counts,
                                      std::uint32_t guess) const {
  const auto found = tree_->nearest_of(p, within, counts, guess);
  if (found.triangle == ClosestPoint::no_guess) return {found.distance, found.triangle, found.triangle};
  return {found.distance, owner_[found.triangle], found.triangle};
}

}  // namespace wrlkit::simplify
