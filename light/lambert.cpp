#include "light/lambert.h"

#include <algorithm>

namespace wrlkit::light {
namespace {

/// A triangle that planes have cut: each adds a corner at the most.
struct Polygon {
  V3 corner[5];
  int n = 0;

  void add(const V3& p) { corner[n++] = p; }
  const V3& after(int i) const { return corner[i + 1 < n ? i + 1 : 0]; }
};

/// What lies above the plane through the origin.
Polygon above(const V3& normal, const Polygon& from) {
  if (std::all_of(from.corner, from.corner + from.n, [&](const V3& p) { return dot(normal, p) >= 0; })) return from;
  Polygon out;
  for (int i = 0; i < from.n; ++i) {
    const V3 &a = from.corner[i], &b = from.after(i);
    const double over_a = dot(normal, a), over_b = dot(normal, b);
    if (over_a >= 0) out.add(a);
    if ((over_a > 0 && over_b < 0) || (over_a < 0 && over_b > 0)) out.add(a + (over_a / (over_a - over_b)) * (b - a));
  }
  return out;
}

/// angle / sin(angle) by the cosine. Few angles are large, and for the others a few terms of 2^k (k!)^2 / (2k + 1)! (1
/// - cos)^k do.
double angle_by_sine(double cosine) {
  const double d = 1 - cosine;
  if (d > 0.1) {
    const double sine2 = d * (1 + cosine);
    return sine2 > 0 ? std::acos(std::max(-1.0, cosine)) / std::sqrt(sine2) : 0;  // straight through the place itself
  }
  double sum = 1;
  for (int k = 6; k > 0; --k) sum = 1 + d * k / (2 * k + 1) * sum;
  return sum;
}

}  // namespace

double irradiance_of(const V3 (&corner)[3], const Receiver& at) {
  Polygon p;
  for (const V3& c : corner) p.add(c);
  p = above(at.normal, p);
  // Where shading bends the normal the face may hide some of it.
  if (dot(at.normal, at.face) < 1 - 1e-12) p = above(at.face, p);
  for (int i = 0; i < p.n; ++i) {
    const double distance = length(p.corner[i]);
    if (!(distance > 0)) return 0;  // the place is a corner of it
    p.corner[i] = (1 / distance) * p.corner[i];
  }
  double sum = 0;
  for (int i = 0; i < p.n; ++i)
    sum += angle_by_sine(dot(p.corner[i], p.after(i))) * dot(cross(p.corner[i], p.after(i)), at.normal);
  return 0.5 * std::fabs(sum);
}

}  // namespace wrlkit::light
