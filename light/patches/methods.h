// Three ways to find the light that falls on each patch of a scene: Lazanyi's "various methods" (3.1). They differ in
// how they come to a result, not in the result: all err around the same solution, by as much as their samples are few.
//
//   path                   each patch follows light back from many of its places to where it is made: Monte Carlo path
//                          tracing (Kajiya 1986), with rays to lamps and emitters at each reflection
//   stochastic-iteration   all patches gather along one random ray each from what all had before; the mean of many such
//                          steps is the solution (Szirmay-Kalos 1999): all orders of reflection for one ray a step
//   progressive-radiosity  the patches that have most light left to give give it first, along as many rays as it is
//   worth
//                          (Cohen et al. 1988; the form factors by rays); what is left in the end is shared by all
//
// Patches reflect diffusely, with one reflectance each. The same numbers for any number of threads.
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/choice.h"
#include "light/patches/patched_world.h"

namespace wrlkit {

namespace light {
enum class Method : std::uint8_t { path, stochastic_iteration, progressive_radiosity };
}
template <>
inline constexpr auto choices<light::Method> =
    choice_row({{"path"}, {"stochastic-iteration"}, {"progressive-radiosity"}});

namespace light {

struct MethodOptions {
  int samples = 256;  // rays a patch side: paths, steps, or rays for all the light of the world a side
  std::uint64_t seed = 1;
  std::function<void(double)> done = [](double) {};  // told now and then how much of the work is done, up to 1
};

/// Irradiance of each side of the world.
std::vector<V3> illuminate(const PatchedWorld& world, Method method, const MethodOptions& options);

std::vector<V3> follow_paths(const PatchedWorld& world, const MethodOptions& options);
std::vector<V3> iterate_stochastically(const PatchedWorld& world, const MethodOptions& options);
std::vector<V3> shoot_progressively(const PatchedWorld& world, const MethodOptions& options);

/// The radiance that leaves a side with this irradiance: emitted and reflected.
inline V3 radiance(const PatchedWorld& world, std::uint32_t side, const V3& irradiance) {
  return world.emission(side) + (1 / pi) * (world.albedo(side) * irradiance);
}

/// Calls f(s) for all sides, on all threads.
void for_sides(std::uint32_t begin, std::uint32_t end, const std::function<void(std::uint32_t)>& f);

}  // namespace light
}  // namespace wrlkit
