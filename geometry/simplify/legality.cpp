#include "geometry/simplify/legality.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/closest_point.h"

namespace wrlkit::simplify {
namespace {

constexpr double least_cosine = 0.2;     // between the normals of a face before and after
constexpr double turned_cosine = 0.985;  // the same; while no face turns more, none is taken to fold back
constexpr double fold_cosine = 0.866;    // between the normals of two neighbours, without the sign
constexpr double sliver = 0.002;         // twice the area by the sum of the squared sides; 0.29 when equilateral
constexpr double sliver_ratio = 0.5;     // of its square, before and after: what is allowed for slivers that are there

bool same_pair(const Ring& u, const Ring::Face& f, const Ring& v, const Ring::Face& g) {
  return v.has(g, u.next_vertex(f)) && v.has(g, u.prev_vertex(f));
}

struct Shape {
  Vec3 normal;
  double sides;  // sum of their squares
};

Shape shape(const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 ab = b - a, ac = c - a, bc = c - b;
  return {cross(ab, ac), dot(ab, ab) + dot(ac, ac) + dot(bc, bc)};
}

/// Whether two neighbours look in nearly opposite directions.
bool folded(const Vec3& a, const Vec3& b) {
  const double d = dot(a, b);
  return d < 0 && d * d > fold_cosine * fold_cosine * dot(a, a) * dot(b, b);
}

/// A face that is left, by the vertices next to the one that moves, and its normal before and after.
struct Turn {
  std::uint32_t face, next, prev;
  Vec3 before, after;
};

bool turns_much(const Vec3& before, const Vec3& after) {
  const double d = dot(before, after);
  return d < 0 || d * d < turned_cosine * turned_cosine * dot(before, before) * dot(after, after);
}

/// Whether a face that turns comes to lie back on one of its neighbours, where it did not before.
bool folds_back(const Surface& surface, const Ring& u, const Ring& v, const Vec3& x) {
  Turn turns[2 * Ring::max_faces];
  std::size_t n = 0;
  for (const Ring* ring : {&u, &v})
    for (const Ring::Face& f : ring->face_span()) {
      if (ring->has(f, ring == &u ? v.center : u.center)) continue;
      const std::uint32_t a = ring->next_vertex(f), b = ring->prev_vertex(f);
      turns[n++] = {f.face, a, b, surface.normal(f.face), cross(surface.position(a) - x, surface.position(b) - x)};
    }
  for (const Turn& f : std::span(turns, n)) {
    if (!turns_much(f.before, f.after)) continue;
    for (const Turn& g : std::span(turns, n))
      if ((g.next == f.prev || g.prev == f.next) && folded(f.after, g.after) && !folded(f.before, g.before))
        return true;
    const auto g = surface.across(f.face, f.next, f.prev);
    if (g == none) continue;
    const Vec3 normal = surface.normal(g);
    if (folded(f.after, normal) && !folded(f.before, normal)) return true;
  }
  return false;
}

bool face_keeps_shape(const Surface& s, const Ring& ring, const Ring::Face& f, const Vec3& x, bool& turns) {
  const Vec3 &p = s.position(ring.center), &a = s.position(ring.next_vertex(f)), &b = s.position(ring.prev_vertex(f));
  Shape before = shape(p, a, b), after = shape(x, a, b);
  double turn = dot(before.normal, after.normal), nb = dot(before.normal, before.normal),
         na = dot(after.normal, after.normal);
  if (nb == 0) return true;
  if (!(turn > 0) || turn * turn < least_cosine * least_cosine * na * nb) return false;
  turns |= turns_much(before.normal, after.normal);
  double qa = na * before.sides * before.sides, qb = nb * after.sides * after.sides;
  return na > sliver * sliver * after.sides * after.sides || qa > sliver_ratio * qb;
}

}  // namespace

bool keeps_topology(const Ring& u, const Ring& v) {
  std::uint32_t pu = u.center, pv = v.center;
  int n_after = 0;
  bool common[2 * Ring::max_faces] = {}, any_pair = false;  // of the spokes of u: whether v has it too
  int n_common = 0, n_opposite = 0;
  for (int i = 0; i < u.n_spokes; ++i)
    if (u.spokes[i].vertex != pv && v.find(u.spokes[i].vertex) >= 0) {
      common[i] = true;
      ++n_common;
    }
  bool seen[2 * Ring::max_faces] = {};
  for (const Ring::Face& f : u.face_span()) {
    if (!u.has(f, pv)) {
      any_pair |= common[f.next] && common[f.prev];
      ++n_after;
      continue;
    }
    std::uint8_t w = u.next_vertex(f) == pv ? f.prev : f.next;
    if (!seen[w]) {
      seen[w] = true;
      ++n_opposite;
    }
    if (u.spokes[w].feature && v.spokes[v.find(u.spokes[w].vertex)].feature) return false;
  }
  if (n_common != n_opposite || n_opposite == 0) return false;
  for (const Ring::Face& g : v.face_span()) n_after += !v.has(g, pu);
  if (n_after > Ring::max_faces || n_after == 0) return false;
  if (any_pair)
    for (const Ring::Face& f : u.face_span())
      for (const Ring::Face& g : v.face_span())
        if (!u.has(f, pv) && !v.has(g, pu) && same_pair(u, f, v, g)) return false;
  return true;
}

bool keeps_shape(const Surface& surface, const Ring& u, const Ring& v, const Vec3& x, bool may_fold) {
  bool turns = false;
  for (const Ring::Face& f : u.face_span())
    if (!u.has(f, v.center) && !face_keeps_shape(surface, u, f, x, turns)) return false;
  for (const Ring::Face& f : v.face_span())
    if (!v.has(f, u.center) && !face_keeps_shape(surface, v, f, x, turns)) return false;
  return !turns || may_fold || !folds_back(surface, u, v, x);
}

double squared_loss_at_fold(const Surface& surface, const Ring& u, const Ring& v, const Vec3& x) {
  const Vec3 first = surface.normal(u.faces[0].face);
  auto turned = [&](const Ring::Face& f) { return dot(surface.normal(f.face), first) < 0; };
  if (std::ranges::none_of(u.face_span(), turned) && std::ranges::none_of(v.face_span(), turned)) return 0;
  double loss = 0;
  for (const Ring* from : {&u, &v}) {
    const Vec3& p = surface.position(from->center);
    double nearest = p == x ? 0 : std::numeric_limits<double>::infinity();
    for (const Ring* ring : {&u, &v})
      for (const Ring::Face& f : ring->face_span())
        if (!ring->has(f, ring == &u ? v.center : u.center))
          nearest = std::min(nearest, squared_distance(p, {x, surface.position(ring->next_vertex(f)),
                                                           surface.position(ring->prev_vertex(f))}));
    loss = std::max(loss, nearest);
  }
  return loss;
}

double deviation(const Surface& surface, const Ring& u, const Ring& v, const Vec3& x) {
  double largest = 0;  // squared
  for (const Ring* ring : {&u, &v}) {
    Vec3 d = x - surface.position(ring->center);
    if (d == Vec3{}) continue;
    for (const Ring::Face& f : ring->face_span()) {
      Vec3 n = surface.normal(f.face);
      double h = dot(n, d), l = dot(n, n);
      if (l > 0) largest = std::max(largest, h * h / l);
    }
    for (const Ring::Spoke& s : ring->spoke_span()) {
      if (!s.feature) continue;
      Vec3 e = surface.position(s.vertex) - surface.position(ring->center), c = cross(e, d);
      double l = dot(e, e);
      if (l > 0) largest = std::max(largest, dot(c, c) / l);
    }
  }
  return std::sqrt(std::max(largest, squared_loss_at_fold(surface, u, v, x)));
}

}  // namespace wrlkit::simplify
