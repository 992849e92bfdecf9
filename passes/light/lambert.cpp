#include "passes/light/lambert.h"

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
  Polygon out;
  for (int i = 0; i < from.n; ++i) {
    const V3 &a = from.corner[i], &b = from.after(i);
    const double over_a = dot(normal, a), over_b = dot(normal, b);
    if (over_a >= 0) out.add(a);
    if ((over_a > 0 && over_b < 0) || (over_a < 0 && over_b > 0)) out.add(a + (over_a / (over_a - over_b)) * (b - a));
  }
  return out;
}

}  // namespace

double irradiance_of(const V3 (&corner)[3], const Receiver& at) {
  Polygon p;
  for (const V3& c : corner) p.add(c);
  p = above(at.normal, p);
  // Where shading bends the normal the face may hide some of it.
  if (dot(at.normal, at.face) < 1 - 1e-12) p = above(at.face, p);
  double sum = 0;
  for (int i = 0; i < p.n; ++i) {
    const V3 across = cross(p.corner[i], p.after(i));
    const double sine = length(across);  // times both distances, as the cosine
    if (sine > 0) sum += std::atan2(sine, dot(p.corner[i], p.after(i))) * dot(across, at.normal) / sine;
  }
  return 0.5 * std::fabs(sum);
}

}  // namespace wrlkit::light
