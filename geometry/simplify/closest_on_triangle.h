// The point of a triangle that is nearest to another point, by its barycentric coordinates (Ericson, Real-Time
// Collision Detection, 5.1.5).
#pragma once
#include <array>
#include <cmath>
#include <limits>

#include "base/math/vec.h"

namespace wrlkit::simplify {

struct ClosestOnTriangle {
  double squared = std::numeric_limits<double>::infinity();  // distance
  std::array<double, 3> at{};                                // adds up to 1
};

inline ClosestOnTriangle closest_on_triangle(const Vec3& p, const std::array<Vec3, 3>& c) {
  const Vec3 ab = c[1] - c[0], ac = c[2] - c[0], ap = p - c[0];
  auto found = [&](double v, double w) {
    const Vec3 away = ap - v * ab - w * ac;
    return ClosestOnTriangle{dot(away, away), {1 - v - w, v, w}};
  };
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return found(0, 0);
  const Vec3 bp = p - c[1];
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return found(1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return found(d1 > d3 ? d1 / (d1 - d3) : 0, 0);
  const Vec3 cp = p - c[2];
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return found(0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return found(0, d2 > d6 ? d2 / (d2 - d6) : 0);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double all = (d4 - d3) + (d5 - d6), w = all > 0 ? (d4 - d3) / all : 0;
    return found(1 - w, w);
  }
  const double all = 1 / (va + vb + vc);
  return found(vb * all, vc * all);
}

/// The way from a point to a triangle; none is longer than the root of `most`.
inline Vec3 way_to(const Vec3& p, const std::array<Vec3, 3>& c, double most = std::numeric_limits<double>::infinity()) {
  const auto found = closest_on_triangle(p, c);
  const Vec3 way = found.at[0] * c[0] + found.at[1] * c[1] + found.at[2] * c[2] - p;
  return found.squared > most ? std::sqrt(most / found.squared) * way : way;
}

}  // namespace wrlkit::simplify
