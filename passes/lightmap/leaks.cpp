#include "passes/lightmap/leaks.h"

#include <algorithm>
#include <vector>

namespace wrlkit::bake {
namespace {

using drawing::V3;
using light::Emitter;
using light::LightWorld;

constexpr std::size_t most_looked_at = 4096, most_asked = 4;

/// Two rays that are askew to what people build: where closed surfaces meet, one alone may be wrong.
constexpr V3 askew[] = {{0.61, 0.53, 0.59}, {-0.57, 0.62, -0.54}};

bool is_hidden(const LightWorld& world, const V3& from, const V3& face) {
  return std::ranges::all_of(askew, [&](const V3& d) { return world.encloses({from, unit(face + 0.3 * d)}); });
}

bool is_in_the_open(const LightWorld& world, const V3& from) {
  return std::ranges::none_of(askew, [&](const V3& d) { return world.encloses({from, unit(d)}); });
}

/// What an emitter would give if nothing stood between, as far as its middle tells.
double strength(const Emitter& e, const light::Point& p) {
  const V3 way = e.at(1. / 3, 1. / 3) - p.position, across = e.across();
  const double d2 = dot(way, way), there = -dot(across, way), here = dot(p.face, way);
  if (!(d2 > 0) || !(here > 0) || !(e.both_sides || there > 0)) return 0;
  return light::mean(e.radiance) * std::abs(there) * here / (d2 * d2);
}

std::vector<const Emitter*> strongest_of(const LightWorld& world, const light::Point& p) {
  const auto all = world.emitters();
  const std::size_t step = all.size() / most_looked_at + 1;
  std::vector<std::pair<double, const Emitter*>> found;
  for (std::size_t i = 0; i < all.size(); i += step)
    if (const double s = strength(all[i], p); s > 0) found.push_back({s, &all[i]});
  const auto n = std::min(most_asked, found.size());
  std::ranges::partial_sort(found, found.begin() + static_cast<std::ptrdiff_t>(n), std::ranges::greater(),
                            &std::pair<double, const Emitter*>::first);
  std::vector<const Emitter*> out;
  for (std::size_t i = 0; i < n; ++i) out.push_back(found[i].second);
  return out;
}

/// A place of an emitter that touches a wall lies in the wall: what counts is the air a thousandth of the way from it.
bool comes_from_outside(const LightWorld& world, const V3& start, const Emitter& e) {
  constexpr double beside = 1e-3, places[][2] = {{1. / 3, 1. / 3}, {0.1, 0.1}, {0.8, 0.1}, {0.1, 0.8}};
  return std::ranges::any_of(places, [&](const auto& at) {
    const V3 way = e.at(at[0], at[1]) - start;
    const double distance = length(way);
    return world.transmittance({start, (1 / distance) * way}, (1 - beside) * distance) > 0 &&
           is_in_the_open(world, start + (1 - beside) * way);
  });
}

}  // namespace

bool is_lit_from_outside(const LightWorld& world, const light::Point& p) {
  const V3 start = world.off_surface(p.position, p.face, p.extent);
  if (!is_hidden(world, start, p.face)) return false;
  return std::ranges::any_of(strongest_of(world, p),
                             [&](const Emitter* e) { return comes_from_outside(world, start, *e); });
}

}  // namespace wrlkit::bake
