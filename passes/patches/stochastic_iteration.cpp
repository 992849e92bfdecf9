// L(n+1) = Le + T*(n) L(n): see methods.h. T*(n) is a transport operator drawn anew for each step, with the mean T: every
// side sends one ray from a random place of its own in a random direction, and takes the light that the side there had in
// the step before. L(n) does not converge, it wanders about the solution; the mean of all L(n) converges to it, because
// what a side gathers has the right mean whatever the others have just now. As no ray brings more than the greatest L(n)
// times a reflectance, it cannot run away.
//
// Emitted light is not waited for: each step sends rays to lamps and emitters as well, and L is what is reflected.
#include <bit>

#include "passes/light/transport.h"
#include "passes/patches/methods.h"

namespace wrlkit::light {
namespace {

constexpr int lamp_rays = 2;
constexpr int most_unheard = 32;     // steps before the mean is taken: light must have got around

/// A permutation of 0 to n - 1. Steps of one side that follow each other must be independent, which points of a lattice in
/// their order are not.
std::uint32_t shuffled(std::uint32_t i, std::uint32_t n, std::uint64_t key) {
  const std::uint32_t mask = std::bit_ceil(n) - 1;
  const int half = std::bit_width(mask) / 2 + 1;
  do {
    for (int round = 0; round < 3; ++round) {
      i = ((i ^ static_cast<std::uint32_t>(key >> (8 * round))) * static_cast<std::uint32_t>(key >> 24 | 1)) & mask;
      i ^= i >> half;
    }
  } while (i >= n);
  return i;
}

class Iteration {
 public:
  Iteration(const PatchedWorld& world, const MethodOptions& options)
      : world_(world), options_(options), direct_(world.world()), transport_(world.world(), direct_, nullptr),
        n_unheard_(std::min(most_unheard, options.samples)), reflected_(world.n_sides()), next_(world.n_sides()), sum_(world.n_sides()) {}

  std::vector<V3> run() {
    const auto n_sides = static_cast<std::uint32_t>(world_.n_sides());
    const int n_steps = n_unheard_ + options_.samples;
    for (int n = 0; n < n_steps; ++n) {
      for_sides(0, n_sides, [&](std::uint32_t s) { step(s, static_cast<std::uint32_t>(n)); });
      reflected_.swap(next_);
      options_.done(static_cast<double>(n + 1) / n_steps);
    }
    for (auto& e : sum_) e = (1.0 / options_.samples) * e;
    return std::move(sum_);
  }

 private:
  void step(std::uint32_t s, std::uint32_t n) {
    if (!(world_.area(s) > 0)) return;
    const auto n_unheard = static_cast<std::uint32_t>(n_unheard_);
    const bool heard = n >= n_unheard;
    const auto key = key_of(options_.seed, heard ? 20 : 21, s);
    const auto i = heard ? shuffled(n - n_unheard, static_cast<std::uint32_t>(options_.samples), key) : n;
    const auto [pu, pv] = Lattice<2>(key_of(key, 1))[i];
    const auto [du, dv] = Lattice<2>(key_of(key, 2))[i];
    Stream random(key_of(key, 3, i));
    const Receiver at = world_.receiver(s, pu, pv);
    Flux f;
    direct_.lamps(at, lamp_rays, random, f);
    direct_.emitters(at, Lattice<3>(key_of(key, 4)), i, 1, f);
    const V3 e = f.sum + pi * along(at, {at.start, cosine_direction(at.normal, du, dv)});
    next_[s] = (1 / pi) * (world_.albedo(s) * e);
    if (heard) sum_[s] += e;
  }

  V3 along(const Receiver& at, const Ray& ray) const {
    V3 sum;
    const double open = transport_.each_layer(ray, [&](const Hit& hit, const SurfacePoint& p, double part) {
      if (mean(p.emission) > 0) sum += part * direct_.gather_weight(at, ray, hit) * p.emission;
      const auto side = world_.side_at(hit, ray.at(hit.distance));
      // What a side reflects has its alpha in it, as `part` has.
      if (side != PatchedWorld::none && part > 0) sum += (part / p.alpha) * reflected_[side];
    });
    return open > 0 && world_.world().has_sky() ? sum + open * world_.world().sky(ray.direction) : sum;
  }

  const PatchedWorld& world_;
  const MethodOptions& options_;
  DirectLight direct_;
  Transport transport_;
  int n_unheard_;
  std::vector<V3> reflected_, next_, sum_;  // radiance before and after a step; irradiance of all steps
};

}  // namespace

std::vector<V3> iterate_stochastically(const PatchedWorld& world, const MethodOptions& options) { return Iteration(world, options).run(); }

}  // namespace wrlkit::light
