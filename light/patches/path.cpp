// Path tracing: see methods.h. Places on a patch and directions come from one lattice, so a patch is sampled evenly.
#include <algorithm>

#include "light/patches/methods.h"
#include "light/transport.h"

namespace wrlkit::light {
namespace {

constexpr int lamp_rays = 2;
constexpr std::uint32_t portion = 4096;  // sides between two reports

V3 irradiance_of(const PatchedWorld& world, const DirectLight& direct, const Transport& transport, std::uint32_t side,
                 const MethodOptions& o) {
  if (!(world.area(side) > 0)) return {};
  const auto key = random_key(o.seed, 10, side);
  RandomStream random(key);
  const Lattice<4> ways(random_key(key, 1));
  const Lattice<3> targets(random_key(key, 3));
  V3 sum;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(o.samples); ++i) {
    const auto [pu, pv, du, dv] = ways[i];
    const Receiver at = world.receiver(side, pu, pv);
    Flux f;
    direct.lamps(at, lamp_rays, random, f);
    direct.emitters(at, targets, i, 1, f);
    const Arriving a = transport.gather(at, {at.start, cosine_direction(at.normal, du, dv)}, random);
    sum += f.sum + pi * (a.direct + a.reflected);
  }
  return (1.0 / o.samples) * sum;
}

}  // namespace

std::vector<V3> follow_paths(const PatchedWorld& world, const MethodOptions& options) {
  const DirectLight direct(world.world());
  const Transport transport(world.world(), direct, nullptr);
  const auto n = static_cast<std::uint32_t>(world.n_sides());
  std::vector<V3> out(n);
  for (std::uint32_t begin = 0; begin < n; begin += portion) {
    for_sides(begin, std::min(n, begin + portion),
              [&](std::uint32_t s) { out[s] = irradiance_of(world, direct, transport, s, options); });
    options.done(static_cast<double>(std::min(n, begin + portion)) / n);
  }
  return out;
}

}  // namespace wrlkit::light
