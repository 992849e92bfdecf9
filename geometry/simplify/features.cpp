#include "geometry/simplify/features.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wrlkit::simplify {
namespace {

constexpr int line = 1, crease = 8;  // of the first corner

class Finder {
 public:
  Finder(Surface& surface, const Wedges& wedges, const FeatureOptions& options)
      : surface_(surface), wedges_(wedges), options_(options), cosine_(std::cos(options.crease_angle)) {}

  /// An edge is looked at from the lower of its vertices that have not too many faces; so when it is the turn of a
  /// vertex, its edges to lower ones are known.
  void run() {
    for (std::uint32_t v = 0; v < surface_.n_vertices(); ++v) {
      bool ring = surface_.gather(v, ring_);
      for (int s = 0; ring && s < ring_.n_spokes; ++s) {
        std::uint32_t w = ring_.spokes[s].vertex;
        if (w > v || surface_.degree(w) > Ring::max_faces) mark(s, bits(s));
      }
      if (ring) surface_.classify(ring_);
      if (!ring || !one_fan()) surface_.vertex[v].kind = surface_.vertex[v].crease_kind = Kind::fixed;
    }
  }

 private:
  int bits(int spoke) const {
    const Ring::Face* at[2] = {};
    int n = 0;
    for (const Ring::Face& f : ring_.face_span())
      if (f.next == spoke || f.prev == spoke) at[n++ % 2] = &f;
    if (n == 1) return options_.borders ? line : 0;
    if (n > 2 || (at[0]->next == spoke) == (at[1]->next == spoke)) return line;  // or wound against each other
    return (is_seam(*at[0], *at[1], spoke) ? line : 0) |
           (options_.creases && is_crease(at[0]->face, at[1]->face) ? crease : 0);
  }

  bool is_crease(std::uint32_t f, std::uint32_t g) const {
    Vec3 a = surface_.normal(f), b = surface_.normal(g);
    return dot(a, b) < cosine_ * std::sqrt(dot(a, a) * dot(b, b));
  }

  bool is_seam(const Ring::Face& f, const Ring::Face& g, int spoke) const {
    if (!wedges_.present()) return false;
    return wedges_.differ(wedge(f, f.corner), wedge(g, g.corner), cosine_) ||
           wedges_.differ(wedge(f, other(f, spoke)), wedge(g, other(g, spoke)), cosine_);
  }
  static int other(const Ring::Face& f, int spoke) { return (f.corner + (f.next == spoke ? 1 : 2)) % 3; }
  std::uint32_t wedge(const Ring::Face& f, int corner) const { return wedges_.of_face[f.face][corner]; }

  void mark(int spoke, int bits) {
    if (bits == 0) return;
    ring_.spokes[spoke].feature |= (bits & line) != 0;
    ring_.spokes[spoke].crease |= (bits & crease) != 0;
    for (const Ring::Face& f : ring_.face_span()) {
      if (f.next == spoke) surface_.face[f.face].features |= bits << f.corner;
      if (f.prev == spoke) surface_.face[f.face].features |= bits << (f.corner + 2) % 3;
    }
  }

  /// Whether the faces around the vertex hang together by their edges there.
  bool one_fan() const {
    std::uint8_t group[2 * Ring::max_faces];
    std::iota(group, group + ring_.n_spokes, std::uint8_t{0});
    auto root = [&](std::uint8_t s) {
      while (group[s] != s) s = group[s] = group[group[s]];
      return s;
    };
    int n_groups = ring_.n_spokes;
    for (const Ring::Face& f : ring_.face_span()) {
      std::uint8_t a = root(f.next), b = root(f.prev);
      if (a != b) {
        group[a] = b;
        --n_groups;
      }
    }
    return n_groups == 1;
  }

  Surface& surface_;
  const Wedges& wedges_;
  const FeatureOptions& options_;
  double cosine_;
  Ring ring_;
};

}  // namespace

void find_features(Surface& surface, const Wedges& wedges, const FeatureOptions& options) {
  Finder(surface, wedges, options).run();
  for (std::uint32_t v = 0; !options.fixed.empty() && v < surface.n_vertices(); ++v)
    if (std::ranges::binary_search(options.fixed, surface.original(v)))
      surface.vertex[v].kind = surface.vertex[v].crease_kind = Kind::fixed;
}

}  // namespace wrlkit::simplify
