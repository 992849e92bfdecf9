// The memoryless criterion after Lindstrom and Turk (Fast and Memory Efficient Polygonal Simplification, 1998;
// Evaluation of Memoryless Simplification, 1999): the new vertex is where the squared distances from the planes of the
// faces around the edge, and from the lines of the features, are least, among the places that keep the volume. Theirs
// weigh a distance by the squared area of its face, ours by the area: that is what an RMS distance counts, and measures
// 2 to 3 % better.
//
// The sum over the faces of a vertex is kept for each vertex, relative to the vertex itself. All its faces and feature
// lines pass through it, so the sum is a matrix A and the normals' sum n, and nothing else. Moving it to the other end
// of an edge e gives linear and constant terms -A e and e A e; what the two ends of an edge have in common is taken
// away once.
#include <algorithm>
#include <cmath>

#include "geometry/simplify/criterion.h"
#include "geometry/simplify/symmetric_matrix.h"

namespace wrlkit::simplify {
namespace {

constexpr double line_weight =
    9;  // of the squared distance from a line by its length, against that from a plane by its area
constexpr double length_cost = 1e-12;  // of the squared length, which decides where the surface is flat

struct Metric {
  SymmetricMatrix planes;
  Vec3 normal{};  // sum of the faces' normals

  void add(const Metric& m, double s) {
    planes.add(m.planes, s);
    normal = normal + s * m.normal;
  }
};

class LindstromTurk final : public Pricer {
 public:
  explicit LindstromTurk(const Surface& surface) : Pricer(surface), metric_(surface.n_vertices()) {
    for (std::uint32_t f = 0; f < surface.n_slots(); ++f)
      if (surface.alive(f)) add_face(f, 1, none, none);
  }

  /// Where there are no lines, all is known before: each vertex around gets the difference that a face makes, at once.
  void before_merge(const Ring& from, const Ring& to, const Vec3& x) override {
    std::uint32_t u = from.center, v = to.center;
    fetch(to);
    done_ = !has_lines(from) && !has_lines(to);
    if (done_) return move(from, to, x);
    for (const Ring::Face& f : from.face_span()) add_face(f.face, -1, u, v);
    for (const Ring::Face& f : to.face_span())
      if (!to.has(f, u)) add_face(f.face, -1, u, v);
  }

  void after_merge(const Ring& from, const Ring& to) override {
    if (done_) return;
    metric_[to.center] = {};
    for (const Ring* ring : {&from, &to})
      for (const Ring::Face& f : ring->face_span())
        if (surface_.alive(f.face)) add_face(f.face, 1, none, none);
  }

 protected:
  void prepare(const Ring& ring, int spokes) override {
    fetch(ring);
    for (int i = 0; i < ring.n_faces; ++i) {
      const Ring::Face& f = ring.faces[i];
      if (spokes < 0 || f.next == spokes || f.prev == spokes) faces_[i] = face_metric(surface_.normal(f.face));
    }
  }
  Option option(const Ring& ring, int spoke, Placement where) const override;

 private:
  void fetch(const Ring& ring) const {
    for (const Ring::Spoke& s : ring.spoke_span()) {
      const char* m = reinterpret_cast<const char*>(&metric_[s.vertex]);
      __builtin_prefetch(m);
      __builtin_prefetch(m + sizeof(Metric) - 1);
    }
  }
  /// Plane and normal, which every corner of a face has.
  Metric face_metric(const Vec3& normal) const {
    Metric m;
    double l = dot(normal, normal);
    if (l > 0) m.planes.add_outer(normal, 1 / std::sqrt(l));
    m.normal = normal;
    return m;
  }
  bool has_lines(const Ring& ring) const {
    return std::ranges::any_of(ring.face_span(),
                               [&](const Ring::Face& f) { return surface_.face[f.face].features & 7; });
  }

  void move(const Ring& from, const Ring& to, const Vec3& x) {
    Metric center;
    for (const Ring* ring : {&from, &to}) {
      const std::uint32_t other = ring == &from ? to.center : from.center;
      for (const Ring::Face& f : ring->face_span()) {
        const std::uint32_t a = ring->next_vertex(f), b = ring->prev_vertex(f);
        const Metric before = face_metric(surface_.normal(f.face));
        if (a == other || b == other) {
          if (ring == &from) metric_[a == other ? b : a].add(before, -1);
          continue;
        }
        Metric m = face_metric(cross(surface_.position(a) - x, surface_.position(b) - x));
        center.add(m, 1);
        m.add(before, -1);
        metric_[a].add(m, 1);
        metric_[b].add(m, 1);
      }
    }
    metric_[to.center] = center;
  }

  Vec3 edge(std::uint32_t f, int k) const {
    const auto& v = surface_.face[f].v;
    return surface_.position(v[(k + 1) % 3]) - surface_.position(v[k]);
  }

  /// Adds what a face is to its vertices, except the two.
  void add_face(std::uint32_t f, double sign, std::uint32_t u, std::uint32_t v) {
    Metric m = face_metric(surface_.normal(f));
    for (std::uint32_t w : surface_.face[f].v)
      if (w != u && w != v) metric_[w].add(m, sign);
    if (!(surface_.face[f].features & 7)) return;
    for (int k = 0; k < 3; ++k) {
      if (!(surface_.face[f].features >> k & 1)) continue;
      SymmetricMatrix l = line_matrix(edge(f, k), line_weight);
      for (std::uint32_t w : {surface_.face[f].v[k], surface_.face[f].v[(k + 1) % 3]})
        if (w != u && w != v) metric_[w].planes.add(l, sign);
    }
  }

  /// What the faces at that edge give to both its ends.
  Metric common(const Ring& ring, int spoke) const {
    Metric m;
    for (int i = 0; i < ring.n_faces; ++i) {
      const Ring::Face& f = ring.faces[i];
      if (f.next == spoke || f.prev == spoke) m.add(faces_[i], 1);
    }
    const Ring::Spoke& s = ring.spokes[spoke];
    if (s.feature)
      m.planes.add(line_matrix(surface_.position(s.vertex) - surface_.position(ring.center), line_weight), s.n_faces);
    return m;
  }

  Vec3 best(const SymmetricMatrix& planes, const Vec3& linear, const Vec3& normal, double volume, const Vec3& e,
            bool closed) const;

  std::vector<Metric> metric_;
  Metric faces_[Ring::max_faces];
  bool done_ = false;  // after_merge has nothing left to do
};

/// All is relative to the centre of the ring.
Option LindstromTurk::option(const Ring& ring, int s, Placement where) const {
  std::uint32_t u = ring.center, v = ring.spokes[s].vertex;
  const Vec3 e = surface_.position(v) - surface_.position(u);
  const Metric &mu = metric_[u], &mv = metric_[v], both = common(ring, s);
  SymmetricMatrix planes = mu.planes;
  planes.add(mv.planes, 1);
  planes.add(both.planes, -1);
  const Vec3 linear = mv.planes * e;  // the gradient at the centre, negated and halved
  const double constant = dot(e, linear);
  Vec3 x{};
  if (where == Placement::spoke) x = e;
  if (where == Placement::anywhere) {
    Vec3 n = mu.normal + mv.normal - both.normal;
    x = best(planes, linear, n, dot(mv.normal, e), e, !surface_.vertex[u].open && !surface_.vertex[v].open);
  }
  double cost = dot(x, planes * x) - 2 * dot(linear, x) + constant;
  return {s, std::max(cost, 0.) + length_cost * planes.trace() * dot(e, e), surface_.position(u) + x};
}

/// Where the metric has its minimum, drawn a little to the middle of the edge, which decides where the surface is flat;
/// then along the normal to where the volume is what it was.
Vec3 LindstromTurk::best(const SymmetricMatrix& planes, const Vec3& linear, const Vec3& normal, double volume,
                         const Vec3& e, bool closed) const {
  const Vec3 middle = 0.5 * e;
  const Minimum at(planes, linear, middle);
  if (!at.exists) return middle;
  Vec3 x = at.x;
  auto far = [&](const Vec3& p, double limit) { return !(dot(p - middle, p - middle) <= limit * dot(e, e)); };
  if (closed) {
    Vec3 step = at.inverse * normal;
    double slope = dot(normal, step);
    if (slope > 0) {
      Vec3 y = x + (volume - dot(normal, x)) / slope * step;
      if (!far(y, 4)) x = y;
    }
  }
  return far(x, 9) ? middle : x;
}

}  // namespace

std::unique_ptr<Pricer> lindstrom_turk(const Surface& surface, const Wedges&) {
  return std::make_unique<LindstromTurk>(surface);
}

}  // namespace wrlkit::simplify
