#include "geometry/simplify/nearest_faces.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace wrlkit::simplify {
namespace {

constexpr double flat = 1e-8;          // squared sine below which a triangle is its edges
constexpr double most_penalty = 1e30;  // of which single precision can still be added up

// Vectors of GCC and Clang: loops that choose stay scalar when compilers have to make vectors of them.
using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));
constexpr std::size_t width = 4;

Four least_of(const Four& a, const Four& b) { return a < b ? a : b; }

struct Points {
  Four x, y, z;
};

struct Vec3f {
  float x, y, z;
  explicit Vec3f(const Vec3& v)
      : x(static_cast<float>(v[0])), y(static_cast<float>(v[1])), z(static_cast<float>(v[2])) {}

  Four dot(const Points& p) const { return x * p.x + y * p.y + z * p.z; }
  Points to(const Points& p) const { return {p.x - x, p.y - y, p.z - z}; }
};

/// An edge from where the points are measured from.
struct Edge {
  Vec3f along;
  float inverse = 0;  // of the squared length; of no length: 0

  explicit Edge(const Vec3& e) : along(e) {
    if (const double all = dot(e, e); all > 1e-30) inverse = static_cast<float>(1 / all);
  }
  Four squared(const Points& p) const {
    const Four zero{}, one = zero + 1.F;
    Four t = along.dot(p) * inverse;
    t = t < zero ? zero : t;
    t = t > one ? one : t;
    const Four x = p.x - t * along.x, y = p.y - t * along.y, z = p.z - t * along.z;
    return x * x + y * y + z * z;
  }
};

/// What is needed of a triangle for many points.
struct Face {
  Vec3f first, to_second, for_second, for_third, normal;
  Edge second, third, opposite;
  bool is_flat;

  Face(const std::array<Vec3, 3>& c, const Vec3& origin)
      : first(c[0] - origin),
        to_second(c[1] - c[0]),
        for_second(Vec3{}),
        for_third(Vec3{}),
        normal(Vec3{}),
        second(c[1] - c[0]),
        third(c[2] - c[0]),
        opposite(c[2] - c[1]) {
    const Vec3 ab = c[1] - c[0], ac = c[2] - c[0], n = cross(ab, ac);
    const double nn = dot(n, n);
    is_flat = !(nn > flat * dot(ab, ab) * dot(ac, ac)) || !(nn > 1e-36);
    if (is_flat) return;
    // Their products with the way from the first corner are the barycentric coordinates.
    for_second = Vec3f((1 / nn) * cross(ac, n));
    for_third = Vec3f((1 / nn) * cross(n, ab));
    normal = Vec3f((1 / length(n)) * n);
  }

  Four squared(const Points& p) const {
    const Points q = first.to(p);
    Four edges = least_of(second.squared(q), third.squared(q));
    edges = least_of(edges, opposite.squared(to_second.to(q)));
    if (is_flat) return edges;
    const Four v = for_second.dot(q), w = for_third.dot(q), height = normal.dot(q);
    const Four inside = least_of(least_of(v, w), 1.F - v - w);
    return inside >= Four{} ? height * height : edges;
  }
};

Four load(const std::vector<float>& from, std::size_t i) {
  Four out;
  std::memcpy(&out, from.data() + i, sizeof out);
  return out;
}

}  // namespace

void PointBatch::reset(const Vec3& new_origin) {
  origin = new_origin;
  n = 0;
  for (auto* v : {&x, &y, &z, &penalty}) v->clear();
  label.clear();
}

void PointBatch::add(const Vec3& p) {
  if (n == x.size())
    for (auto* v : {&x, &y, &z}) v->resize(n + width);
  x[n] = static_cast<float>(p[0] - origin[0]);
  y[n] = static_cast<float>(p[1] - origin[1]);
  z[n] = static_cast<float>(p[2] - origin[2]);
  ++n;
}

void PointBatch::add(const Vec3& p, std::uint32_t label_of_p, double penalty_of_p) {
  add(p);
  label.resize(x.size());
  penalty.resize(x.size());
  label[n - 1] = static_cast<std::int32_t>(label_of_p);
  penalty[n - 1] = static_cast<float>(std::min(penalty_of_p, most_penalty));
}

void nearest_faces(std::span<const std::array<Vec3, 3>> faces, std::size_t n, PointBatch& points,
                   std::span<const std::uint32_t> labels) {
  points.squared.assign(points.x.size(), std::numeric_limits<float>::infinity());
  points.face.assign(points.x.size(), 0);
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Face face(faces[k], points.origin);
    const FourInts number = FourInts{} + static_cast<std::int32_t>(k);
    for (std::size_t i = 0; i < n; i += width) {
      Four squared = face.squared({load(points.x, i), load(points.y, i), load(points.z, i)});
      if (!labels.empty()) {
        FourInts label;
        std::memcpy(&label, points.label.data() + i, sizeof label);
        const FourInts of_face = FourInts{} + static_cast<std::int32_t>(labels[k]);
        squared += label == of_face ? Four{} : load(points.penalty, i);
      }
      const Four before = load(points.squared, i);
      FourInts which;
      std::memcpy(&which, points.face.data() + i, sizeof which);
      which = squared < before ? number : which;
      const Four least = least_of(squared, before);
      std::memcpy(points.squared.data() + i, &least, sizeof least);
      std::memcpy(points.face.data() + i, &which, sizeof which);
    }
  }
}

}  // namespace wrlkit::simplify
