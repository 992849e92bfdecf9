// Edges are found in buckets by their lower position, each sorted by the higher one: n log n at worst, no hashing.
#include "geometry/unwrap/links.h"

#include <algorithm>
#include <cmath>

#include "base/math/vec.h"

namespace wrlkit::unwrap {
namespace {

using wrlkit::cross, wrlkit::dot;

constexpr double thin = 1e-5;  // height by longest side, below which single precision cannot tell the front
constexpr double too_large = 1e18;

Vec3 position_at(const UnfoldInput& in, std::uint32_t i) {
  return {in.positions[std::size_t{i} * 3], in.positions[std::size_t{i} * 3 + 1], in.positions[std::size_t{i} * 3 + 2]};
}
bool usable(const Vec3& p) {
  return std::abs(p[0]) < too_large && std::abs(p[1]) < too_large && std::abs(p[2]) < too_large;
}

}  // namespace

Links::Links(const UnfoldInput& in, double crease_angle)
    : in_(in), n_positions_(static_cast<std::uint32_t>(in.positions.size() / 3)) {
  std::size_t n = in.corners.size() / 3;
  flat_.resize(n);
  normal_.resize(n);
  solid_.resize(n);
  finite_.resize(n);
  mate_.assign(3 * n, none);
  for (std::uint32_t t = 0; t < n; ++t) lay_flat(t);
  connect(crease_angle);
}

void Links::lay_flat(std::uint32_t t) {
  const std::uint32_t* c = &in_.corners[std::size_t{t} * 3];
  if (c[0] >= n_positions_ || c[1] >= n_positions_ || c[2] >= n_positions_) return;
  Vec3 a = position_at(in_, c[0]), b = position_at(in_, c[1]), d = position_at(in_, c[2]);
  if (!usable(a) || !usable(b) || !usable(d)) return;
  finite_[t] = 1;
  Vec3 u = b - a, v = d - a, n = cross(u, v);
  double length = std::sqrt(dot(u, u)), area = std::sqrt(dot(n, n));
  if (length > 0)
    flat_[t] = {length, dot(u, v) / length, area / length};
  else
    flat_[t] = {0, std::sqrt(dot(v, v)), 0};
  Vec3 w = d - b;
  solid_[t] = area > thin * std::max({dot(u, u), dot(v, v), dot(w, w)});
  if (!solid_[t]) return;
  normal_[t] = {static_cast<float>(n[0] / area), static_cast<float>(n[1] / area), static_cast<float>(n[2] / area)};
}

double Links::cosine(std::uint32_t t, std::uint32_t u) const {
  if (!solid_[t] || !solid_[u]) return 1;
  const Normal &a = normal_[t], &b = normal_[u];
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

void Links::connect(double crease_angle) {
  struct Edge {
    std::uint32_t high, corner;
    bool operator<(const Edge& o) const { return high != o.high ? high < o.high : corner < o.corner; }
  };
  auto low_of = [&](std::uint32_t c) { return std::min(position(c), position(next_corner(c))); };
  auto counts = [&](std::uint32_t c) {
    std::uint32_t a = position(c), b = position(next_corner(c)), d = position(previous_corner(c));
    return finite_[c / 3] && a != b && b != d && d != a;
  };
  std::vector<std::uint32_t> begin(std::size_t{n_positions_} + 2, 0);
  std::uint32_t n = 3 * n_triangles();
  for (std::uint32_t c = 0; c < n; ++c)
    if (counts(c)) ++begin[low_of(c) + 2];
  for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Edge> edges(begin.back());
  for (std::uint32_t c = 0; c < n; ++c)
    if (counts(c)) edges[begin[low_of(c) + 1]++] = {std::max(position(c), position(next_corner(c))), c};
  double crease_cosine = std::cos(crease_angle);
  for (std::uint32_t p = 0; p < n_positions_; ++p) {
    auto first = edges.begin() + begin[p], last = edges.begin() + begin[p + 1];
    std::sort(first, last);
    for (auto e = first; e != last;) {
      auto end = e;
      while (end != last && end->high == e->high) ++end;
      if (end - e == 2) join(e[0].corner, e[1].corner, crease_cosine);
      e = end;
    }
  }
}

void Links::join(std::uint32_t a, std::uint32_t b, double crease_cosine) {
  std::uint32_t t = a / 3, u = b / 3;
  if (position(a) == position(b)) return;
  if (!in_.groups.empty() && in_.groups[t] != in_.groups[u]) return;
  if (cosine(t, u) < crease_cosine) return;
  mate_[a] = b;
  mate_[b] = a;
}

}  // namespace wrlkit::unwrap
