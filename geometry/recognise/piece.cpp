#include "geometry/recognise/piece.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/math/vec.h"

namespace wrlkit::recognising {
namespace {

constexpr double most_bent = 0.94;  // cosine between the normals of faces of one region

Vec3 newell(const Piece& p, std::uint32_t face) {
  Vec3 sum{};
  const Vec3& first = p.points[p.origin[p.begin[face]]];
  for (std::uint32_t h = p.begin[face] + 1; h + 1 < p.begin[face + 1]; ++h)
    sum = sum + cross(p.points[p.origin[h]] - first, p.points[p.origin[h + 1]] - first);
  return sum;
}

class Grower {
 public:
  explicit Grower(Piece& p) : p_(p), flat_(2.5 * p.step + 2e-6 * p.size) {}

  void run() {
    std::vector<std::uint32_t> order(p_.n_faces());
    std::iota(order.begin(), order.end(), 0u);
    std::vector<double> area;
    for (const Vec3& n : p_.normal) area.push_back(dot(n, n));
    std::ranges::stable_sort(order, [&](auto a, auto b) { return area[a] > area[b]; });
    p_.region.assign(p_.n_faces(), none);
    for (auto f : order)
      if (p_.region[f] == none) grow(f);
    for (std::uint32_t h = 0; h < p_.origin.size(); ++h) {
      const auto r = p_.region[p_.face_of[h]];
      p_.region_border[r] += p_.twin[h] == none || p_.region[p_.face_of[p_.twin[h]]] != r;
    }
  }

 private:
  void grow(std::uint32_t seed) {
    const auto number = static_cast<std::uint32_t>(p_.region_begin.size());
    const Vec3 normal = unit(p_.normal[seed]), at = p_.points[p_.origin[p_.begin[seed]]];
    p_.region_begin.push_back(static_cast<std::uint32_t>(p_.by_region.size()));
    p_.region_border.push_back(0);
    p_.region[seed] = number;
    stack_.assign(1, seed);
    while (!stack_.empty()) {
      const auto f = stack_.back();
      stack_.pop_back();
      p_.by_region.push_back(f);
      for (auto h = p_.begin[f]; h < p_.begin[f + 1]; ++h) {
        if (p_.twin[h] == none) continue;
        const auto other = p_.face_of[p_.twin[h]];
        if (p_.region[other] != none || !fits(other, normal, at)) continue;
        p_.region[other] = number;
        stack_.push_back(other);
      }
    }
  }

  bool fits(std::uint32_t f, const Vec3& normal, const Vec3& at) const {
    for (auto h = p_.begin[f]; h < p_.begin[f + 1]; ++h)
      if (std::abs(dot(p_.points[p_.origin[h]] - at, normal)) > flat_) return false;
    const double turned = dot(p_.normal[f], normal), area = length(p_.normal[f]);
    return turned > most_bent * area || (turned >= 0 && area < flat_ * p_.size);
  }

  Piece& p_;
  double flat_;
  std::vector<std::uint32_t> stack_;
};

}  // namespace

void Piece::find_regions() {
  normal.clear();
  for (std::uint32_t f = 0; f < n_faces(); ++f) normal.push_back(newell(*this, f));
  region_border.clear();
  region_begin.clear();
  by_region.clear();
  Grower(*this).run();
  region_begin.push_back(static_cast<std::uint32_t>(by_region.size()));
}

}  // namespace wrlkit::recognising
