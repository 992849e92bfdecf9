// L(n+1) = Le + T*(n) L(n): see methods.h. T*(n) is a transport operator drawn again for each step, with the mean T:
// every side sends one ray from a random place of its own in a random direction, and takes the light that the side
// there had in the step before. L(n) does not converge, it wanders about the solution; the mean of all L(n) converges
// to it, because what a side gathers has the right mean whatever the others have just now. As no ray brings more than
// the greatest L(n) times a reflectance, it cannot run away.
//
// Emitted light is not waited for: each step sends rays to lamps and emitters as well, and L is what is reflected.
#include <algorithm>
#include <bit>
#include <cmath>

#include "light/patches/methods.h"
#include "light/transport.h"

namespace wrlkit::light {
namespace {

constexpr int walk_lamp_rays = 2;
constexpr double not_around = 1e-3;  // share of the light that may be on its way still when the mean begins to be taken
constexpr int most_unheard = 1024;   // steps before that

/// A permutation of 0 to n - 1. Steps of one side that follow each other must be independent, which points of a lattice
/// in their order are not.
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
      : world_(world),
        options_(options),
        direct_(world.world()),
        transport_(world.world(), direct_, nullptr),
        reflected_(world.n_sides()),
        next_(world.n_sides()) {}

  std::vector<V3> run() {
    const int n_unheard = spread();
    const auto n = static_cast<std::uint32_t>(options_.samples);
    std::vector<V3> sum(world_.n_sides());
    for (std::uint32_t i = 0; i < n; ++i) {
      step([&](std::uint32_t s) {
        const auto key = random_key(options_.seed, 20, s);
        const Gathered g = gather(s, key, shuffled(i, n, key));
        sum[s] += g.made + g.reflected;
        return g;
      });
      options_.done((n_unheard + i + 1.0) / (n_unheard + options_.samples));
    }
    for (auto& e : sum) e = (1.0 / n) * e;
    return sum;
  }

 private:
  /// Irradiance along a ray of each kind: from lamps, emitters and the sky, and what sides reflect.
  struct Gathered {
    V3 made, reflected;
  };

  /// Steps until light has got around; returns how many. A step adds one reflection, so what is lacking after n of them
  /// is a share of r^n when a reflection keeps r of the light.
  int spread() {
    std::vector<V3> again(world_.n_sides());  // reflected before, and now once more
    V3 before, after;
    for (int n = 0; n < most_unheard; ++n) {
      for (std::uint32_t s = 0; s < reflected_.size(); ++s) before += world_.area(s) * reflected_[s];
      step([&](std::uint32_t s) {
        const Gathered g = gather(s, random_key(options_.seed, 21, s), static_cast<std::uint32_t>(n));
        again[s] = (1 / pi) * (world_.albedo(s) * g.reflected);
        return g;
      });
      for (std::uint32_t s = 0; s < again.size(); ++s) after += world_.area(s) * again[s];
      auto kept = [](double now, double was) { return was > 0 ? now / was : 0; };
      const double r = std::max({kept(after.x, before.x), kept(after.y, before.y), kept(after.z, before.z)});
      if (n > 0 && std::pow(r, n) < not_around) return n + 1;
      options_.done(n / (n + 1.0 + options_.samples));
    }
    return most_unheard;
  }

  /// `f(s)` is what a side gathers now.
  template <class F>
  void step(F&& f) {
    for_sides(0, static_cast<std::uint32_t>(world_.n_sides()), [&](std::uint32_t s) {
      if (!(world_.area(s) > 0)) return;
      const Gathered g = f(s);
      next_[s] = (1 / pi) * (world_.albedo(s) * (g.made + g.reflected));
    });
    reflected_.swap(next_);
  }

  Gathered gather(std::uint32_t s, std::uint64_t key, std::uint32_t i) const {
    const auto [pu, pv, du, dv] = Lattice<4>(random_key(key, 1))[i];
    RandomStream random(random_key(key, 3, i));
    const Receiver at = world_.receiver(s, pu, pv);
    Flux f;
    direct_.lamps(at, walk_lamp_rays, random, f);
    direct_.emitters(at, Lattice<3>(random_key(key, 4)), i, 1, f);
    Gathered g = along(at, {at.start, cosine_direction(at.normal, du, dv)});
    g.made += f.sum;
    return g;
  }

  Gathered along(const Receiver& at, const Ray& ray) const {
    Gathered g;
    const double open = transport_.each_layer(ray, [&](const Hit& hit, const SurfacePoint& p, double part) {
      if (mean(p.emission) > 0) g.made += (pi * part * direct_.gather_weight(at, ray, hit)) * p.emission;
      const auto side = world_.side_at(hit, ray.at(hit.distance));
      // What a side reflects has its alpha in it, as `part` has.
      if (side != PatchedWorld::none && part > 0) g.reflected += (pi * part / p.alpha) * reflected_[side];
    });
    if (open > 0 && world_.world().has_sky()) g.made += (pi * open) * world_.world().sky(ray.direction);
    return g;
  }

  const PatchedWorld& world_;
  const MethodOptions& options_;
  DirectLight direct_;
  Transport transport_;
  std::vector<V3> reflected_, next_;  // radiance before and after a step
};

}  // namespace

std::vector<V3> iterate_stochastically(const PatchedWorld& world, const MethodOptions& options) {
  return Iteration(world, options).run();
}

}  // namespace wrlkit::light
