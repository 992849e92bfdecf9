#include "light/patches/patch_match.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/math/random.h"
#include "light/patches/patch_mesh.h"

namespace wrlkit::light {
namespace {

std::array<V3, 3> points(const Corners& c) { return {V3(c[0]), V3(c[1]), V3(c[2])}; }
V3 centre(const std::array<V3, 3>& t) { return (1.0 / 3) * (t[0] + t[1] + t[2]); }

class Matcher {
 public:
  Matcher(const PatchSet& set, const LightWorld& world) : set_(set), world_(world) {}

  PatchMatch run() {
    for (std::size_t s = 0; s < set_.shapes.size(); ++s)
      for (std::size_t t = set_.shapes[s].first_triangle; t < set_.end_of_shape(s); ++t) {
        const bool right = is_right(set_.shapes[s], set_.triangles[t]);
        for (auto p = set_.triangles[t].first_patch; p < set_.end_of_triangle(t); ++p) {
          const auto& patch = set_.patches[p];
          if (right)
            out_.placed.push_back(
                {static_cast<std::uint32_t>(p), set_.shapes[s].index, set_.triangles[t].index, patch.back});
          else
            look_for(static_cast<std::uint32_t>(p));
        }
      }
    std::ranges::stable_sort(out_.placed, {}, &PlacedPatch::use);
    return std::move(out_);
  }

 private:
  double tolerance(const std::array<V3, 3>& t) const {
    double largest = 0, longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      for (double v : {t[i].x, t[i].y, t[i].z}) largest = std::max(largest, std::fabs(v));
      longest = std::max(longest, length(t[i] - t[(i + 1) % 3]));
    }
    const double rounding = std::min(std::sqrt(3.0) * set_.printed.step(largest), 0.5 * longest);
    return 1e-3 * std::sqrt(length(across(t))) + 2e-6 * world_.radius() + rounding;
  }

  /// Is the triangle of the file that one of the world?
  bool is_right(const PatchSet::Shape& shape, const PatchSet::Triangle& triangle) const {
    if (!triangle.given || shape.index >= world_.stage().uses.size()) return false;
    const auto& mesh = world_.meshes()[world_.mesh_of()[shape.index]];
    if (mesh.kind != Mesh::Kind::faces || triangle.index >= mesh.n_elements) return false;
    auto ours = triangle_of(world_, shape.index, triangle.index), theirs = points(triangle.corners);
    const double most = tolerance(ours);
    // The corners of a mirrored Shape run the other way.
    if (dot(across(ours), across(theirs)) < 0) std::swap(ours[1], ours[2]);
    return std::ranges::all_of(std::array{0, 1, 2}, [&](int i) { return length(ours[i] - theirs[i]) <= most; });
  }

  /// Looks at the patch's middle from just above it. Of what lies there about as the patch does the nearest counts, and
  /// black backs of solid faces only where there is nothing else.
  void look_for(std::uint32_t p) {
    constexpr int most_layers = 16;
    constexpr double least_cosine = 0.5;  // coarse digits turn small patches
    const auto t = points(set_.patches[p].corners);
    const V3 normal = unit(across(t));
    const double above = 2 * tolerance(t);
    const Ray ray{centre(t) + above * normal, -normal};
    std::optional<Hit> best;
    double least = HUGE_VAL, after = 0;
    Hit hit;
    for (int i = 0;
         dot(normal, normal) > 0 && i < most_layers && world_.nearest(ray, after, hit) && hit.distance <= 2 * above;
         ++i, after = hit.distance) {
      const double off = std::fabs(hit.distance - above) + (is_black(hit, set_.patches[p].back) ? 2 * above : 0);
      if (off < least && std::fabs(dot(unit(hit.across), normal)) > least_cosine) {
        least = off;
        best = hit;
      }
    }
    if (!best) {
      ++out_.n_orphans;
      return;
    }
    out_.placed.push_back({p, best->use, best->element, best->back != set_.patches[p].back});
  }

  bool is_black(const Hit& hit, bool back) const {
    return hit.back != back && world_.meshes()[world_.mesh_of()[hit.use]].solid;
  }

  const PatchSet& set_;
  const LightWorld& world_;
  PatchMatch out_;
};

}  // namespace

PatchMatch match_patches(const PatchSet& set, const LightWorld& world) { return Matcher(set, world).run(); }

std::array<V3, 3> triangle_of(const LightWorld& world, std::uint32_t use, std::uint32_t element) {
  const auto& m = world.meshes()[world.mesh_of()[use]];
  const auto& frame = world.stage().frames[world.stage().uses[use].frame];
  std::array<V3, 3> out;
  for (int k = 0; k < 3; ++k)
    out[static_cast<std::size_t>(k)] = frame.point(world.meshes().position(m, element, k) + m.origin);
  return out;
}

PatchColor color_of(const LightWorld& world, std::uint32_t use, std::uint32_t element, bool back,
                    const std::array<V3, 3>& patch) {
  // The same places whoever asks: what is divided by this mean later must have been multiplied by it.
  static const Lattice<2> places(0);
  const std::uint32_t n = world.is_plain(use) ? 1 : 64;
  const auto triangle = triangle_of(world, use, element);
  PatchColor out;
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto [u, v] = places[i];
    const double root = std::sqrt(u);
    const auto w =
        weights_in(triangle, patch[0] + (root * (1 - v)) * (patch[1] - patch[0]) + (root * v) * (patch[2] - patch[0]));
    const auto p = world.surface({.use = use, .element = element, .back = back, .weights = {w[0], w[1], w[2]}});
    out.albedo += (p.alpha / n) * p.albedo;
    out.emission += (p.alpha / n) * p.emission;
  }
  return out;
}

std::array<double, 3> weights_in(const std::array<V3, 3>& t, const V3& p) {
  const V3 e1 = t[1] - t[0], e2 = t[2] - t[0], d = p - t[0];
  const double a = dot(e1, e1), b = dot(e1, e2), c = dot(e2, e2), x = dot(d, e1), y = dot(d, e2), det = a * c - b * b;
  if (!(det > 0)) return {1, 0, 0};
  const double v = (c * x - b * y) / det, w = (a * y - b * x) / det;
  return {1 - v - w, v, w};
}

}  // namespace wrlkit::light
