#include "tools/report/deviation_map.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/math/box.h"
#include "base/parallel.h"

namespace wrlkit {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

using Corners = std::array<Vec3, 3>;

Vec3 mixed(const Corners& c, double u, double v) {
  Vec3 p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = c[0][k] + u * (c[1][k] - c[0][k]) + v * (c[2][k] - c[0][k]);
  return p;
}

/// Runs f(i) for all i, some thousand at a time.
void for_all(std::size_t n, auto&& f) {
  constexpr std::size_t block = 2048;
  parallel_for((n + block - 1) / block, [&](std::size_t b) {
    for (std::size_t i = b * block; i < std::min(n, (b + 1) * block); ++i) f(i);
  });
}

class Map {
 public:
  Map(const Triangles& surface, const Triangles& other) : surface_(surface), nearest_(other) {}

  std::string write(std::size_t most) {
    measure_corners();
    choose_cuts(most);
    cut();
    return bytes();
  }

 private:
  double distance(const Vec3& p, const Corners& around) const {
    return nearest_.nearest(p, area_normal(around)).distance;
  }

  void measure_corners() {
    std::vector<std::uint32_t> triangle(surface_.positions.size() / 3);  // one that has the position
    for (std::size_t c = 0; c < surface_.corners.size(); ++c)
      triangle[surface_.corners[c]] = static_cast<std::uint32_t>(c / 3);
    positions_.assign(surface_.positions.begin(), surface_.positions.end());
    distances_.resize(triangle.size());
    for_all(triangle.size(), [&](std::size_t i) {
      distances_[i] = distance(surface_.position(static_cast<std::uint32_t>(i)), surface_[triangle[i]]);
    });
  }

  /// How many pieces each side of a triangle gets.
  void choose_cuts(std::size_t most) {
    const std::size_t n = surface_.size();
    cuts_.assign(n, 1);
    if (n >= most || n == 0) return;
    std::vector<double> hidden(n);  // what the corners do not show
    for_all(n, [&](std::size_t t) {
      const Corners c = surface_[t];
      double corner = 0, middle = distance(mixed(c, 1. / 3, 1. / 3), c);
      for (std::size_t k = 0; k < 3; ++k) {
        corner = std::max(corner, distances_[surface_.corners[3 * t + k]]);
        middle = std::max(middle, distance(mixed(c, k == 2 ? 0 : 0.5, k == 0 ? 0 : 0.5), c));
      }
      hidden[t] = std::max(0., middle - corner);
    });
    const double largest = std::max(*std::ranges::max_element(hidden), *std::ranges::max_element(distances_));
    const auto n_hidden =
        static_cast<std::size_t>(std::ranges::count_if(hidden, [&](double d) { return d > 0.02 * largest; }));
    if (n_hidden == 0) return;
    const double pieces = static_cast<double>(most - n) / static_cast<double>(n_hidden);
    const auto side = static_cast<std::uint32_t>(std::clamp(std::sqrt(pieces), 1., 16.));
    for (std::size_t t = 0; t < n; ++t)
      if (hidden[t] > 0.02 * largest) cuts_[t] = side;
  }

  void cut() {
    std::vector<std::uint32_t> owner;  // the triangle of each vertex that is new
    const auto n_old = distances_.size();
    for (std::size_t t = 0; t < surface_.size(); ++t) {
      if (cuts_[t] == 1)
        for (std::size_t k = 0; k < 3; ++k) corners_.push_back(surface_.corners[3 * t + k]);
      else
        cut(t, owner);
    }
    distances_.resize(n_old + owner.size());
    for_all(owner.size(), [&](std::size_t i) {
      const double* p = positions_.data() + 3 * (n_old + i);
      distances_[n_old + i] = distance({p[0], p[1], p[2]}, surface_[owner[i]]);
    });
  }

  void cut(std::size_t t, std::vector<std::uint32_t>& owner) {
    const std::uint32_t n = cuts_[t], first = static_cast<std::uint32_t>(positions_.size() / 3);
    const Corners c = surface_[t];
    for (std::uint32_t row = 0; row <= n; ++row)
      for (std::uint32_t i = 0; i + row <= n; ++i) {
        for (double x : mixed(c, double(i) / n, double(row) / n)) positions_.push_back(x);
        owner.push_back(static_cast<std::uint32_t>(t));
      }
    auto at = [&](std::uint32_t row, std::uint32_t i) { return first + row * (n + 1) - row * (row - 1) / 2 + i; };
    for (std::uint32_t row = 0; row < n; ++row)
      for (std::uint32_t i = 0; i + row < n; ++i) {
        corners_.insert(corners_.end(), {at(row, i), at(row, i + 1), at(row + 1, i)});
        if (i + row + 1 < n) corners_.insert(corners_.end(), {at(row, i + 1), at(row + 1, i + 1), at(row + 1, i)});
      }
  }

  Vec3 origin() const { return positions_.empty() ? Vec3{} : box_of<3, double>(positions_).centre(); }

  std::string bytes() const {
    std::string out;
    auto put = [&](auto x) { out.append(reinterpret_cast<const char*>(&x), sizeof x); };
    put(static_cast<std::uint32_t>(distances_.size()));
    put(static_cast<std::uint32_t>(corners_.size() / 3));
    const Vec3 o = origin();
    for (double x : o) put(x);
    for (std::size_t i = 0; i < positions_.size(); ++i) put(static_cast<float>(positions_[i] - o[i % 3]));
    for (double d : distances_) put(static_cast<float>(d));
    for (std::uint32_t c : corners_) put(c);
    return out;
  }

  const Triangles& surface_;
  const ClosestPoint nearest_;
  std::vector<std::uint32_t> cuts_, corners_;
  std::vector<double> positions_, distances_;
};

}  // namespace

std::string deviation_map(const Triangles& surface, const Triangles& other, std::size_t most) {
  return Map(surface, other).write(most);
}

}  // namespace wrlkit
