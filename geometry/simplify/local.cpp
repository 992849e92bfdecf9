// The two local criteria of Lazanyi's paper. They look at the faces of one vertex and move it into a neighbour, so
// vertices stay where they were measured.
#include <algorithm>
#include <cmath>

#include "geometry/simplify/criterion.h"

namespace wrlkit::simplify {
namespace {

/// A ring with the unit normals of its faces; a face without area has none (0, 0, 0).
class HalfEdges : public Pricer {
 public:
  using Pricer::Pricer;

  bool one_way() const override { return true; }

 protected:
  void prepare(const Ring& ring, int) override {
    for (int i = 0; i < ring.n_faces; ++i) {
      Vec3 n = surface_.normal(ring.faces[i].face);
      double l = dot(n, n);
      normals_[i] = l > 0 ? 1 / std::sqrt(l) * n : Vec3{};
    }
  }
  Option option(const Ring& ring, int spoke, Placement) const override {
    const Vec3& to = surface_.position(ring.spokes[spoke].vertex);
    Vec3 e = to - surface_.position(ring.center);
    return {spoke, cost(ring, spoke, std::sqrt(dot(e, e))), to};
  }
  virtual double cost(const Ring& ring, int spoke, double length) const = 0;

  Vec3 normals_[Ring::max_faces];
};

/// Formula 1: |e| / |n1 . n2|. Edges of other than two faces have no such angle; they cost their length.
class LengthNormal final : public HalfEdges {
  using HalfEdges::HalfEdges;

  double cost(const Ring& ring, int spoke, double length) const override {
    if (ring.spokes[spoke].n_faces != 2) return length;
    const Vec3* n[2] = {};
    for (int i = 0; i < ring.n_faces; ++i)
      if (ring.faces[i].next == spoke || ring.faces[i].prev == spoke) n[n[0] != nullptr] = &normals_[i];
    return length / std::abs(dot(*n[0], *n[1]));
  }
};

/// Formula 2: |e| times the maximum, over the faces f of the centre that the edge has not, of the minimum, over the
/// faces g of the edge, of (1 - nf . ng) / 2. It says nothing of borders, and would cut off the corners of a flat
/// sheet; so along a feature the bend of that line counts in the same way.
class Melax final : public HalfEdges {
  using HalfEdges::HalfEdges;

  double cost(const Ring& ring, int spoke, double length) const override {
    const Vec3* sides[Ring::max_faces];
    int n = 0;
    auto beside = [&](const Ring::Face& f) { return f.next == spoke || f.prev == spoke; };
    for (int i = 0; i < ring.n_faces; ++i)
      if (beside(ring.faces[i])) sides[n++] = &normals_[i];
    double bend = 0;
    for (int i = 0; i < ring.n_faces; ++i) {
      if (beside(ring.faces[i])) continue;
      double least = 1;
      for (int j = 0; j < n; ++j) least = std::min(least, (1 - dot(normals_[i], *sides[j])) / 2);
      bend = std::max(bend, least);
    }
    return length * std::max(bend, bend_of_line(ring, spoke));
  }

  /// How the features that end in the centre go on in that edge: 0 straight, 1 back.
  double bend_of_line(const Ring& ring, int spoke) const {
    if (!ring.spokes[spoke].feature) return 0;
    auto direction = [&](int s) {
      return unit(surface_.position(ring.spokes[s].vertex) - surface_.position(ring.center));
    };
    const Vec3 e = direction(spoke);
    double bend = 0;
    for (int s = 0; s < ring.n_spokes; ++s)
      if (s != spoke && ring.spokes[s].feature) bend = std::max(bend, (1 + dot(e, direction(s))) / 2);
    return bend;
  }
};

}  // namespace

std::unique_ptr<Pricer> length_normal(const Surface& surface, const Wedges&) {
  return std::make_unique<LengthNormal>(surface);
}
std::unique_ptr<Pricer> melax(const Surface& surface, const Wedges&) { return std::make_unique<Melax>(surface); }

}  // namespace wrlkit::simplify
