#include "passes/light/direct.h"

#include <algorithm>

namespace wrlkit::light {
namespace {

/// What a lamp would give when nothing stood between.
struct Candidate {
  V3 irradiance, direction;
  double distance, weight;
};

void add_candidate(std::vector<Candidate>& to, const Lamp& lamp, const Receiver& at) {
  auto a = arrival(lamp.light, at.start);
  double facing = dot(at.normal, a.to_light);
  if (!(a.strength > 0) || !(facing > 0) || !(dot(at.face, a.to_light) > 0)) return;
  V3 e = a.strength * facing * lamp.irradiance;
  to.push_back({e, a.to_light, a.distance, mean(e)});
}

/// Which lamps get a ray for sure: those whose share of the rest of the rays is one or more. Returns the weight of the
/// others, which stand behind.
double put_sure_ones_first(std::vector<Candidate>& all, std::size_t most, std::size_t& n_sure) {
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.weight > b.weight; });
  double rest = 0;
  for (const Candidate& c : all) rest += c.weight;
  n_sure = 0;
  while (n_sure < most && all[n_sure].weight * static_cast<double>(most - n_sure) >= rest) rest -= all[n_sure++].weight;
  return rest;
}

}  // namespace

void DirectLight::lamps(const Receiver& at, int most, Stream& random, Flux& to) const {
  thread_local std::vector<Candidate> all;
  all.clear();
  for (const Lamp& l : world_.lamps()) add_candidate(all, l, at);
  world_.each_directional(at.scope, [&](const Lamp& l) { add_candidate(all, l, at); });
  auto shine = [&](const Candidate& c, double times) {
    double through = world_.transmittance({at.start, c.direction}, c.distance);
    if (through > 0) to.add(through * times * c.irradiance, c.direction);
  };
  std::size_t n = static_cast<std::size_t>(most), n_sure = all.size();
  double rest = all.size() > n ? put_sure_ones_first(all, n, n_sure) : 0;
  for (std::size_t i = 0; i < n_sure; ++i) shine(all[i], 1);
  if (n_sure == all.size() || n_sure == n) return;
  // Equal steps along the sum of the weights: one of the others at each.
  double step = rest / static_cast<double>(n - n_sure), next = random.next() * step, sum = 0;
  for (std::size_t i = n_sure; i < all.size(); ++i) {
    sum += all[i].weight;
    if (next >= sum) continue;
    shine(all[i], step / all[i].weight);
    next += step;
  }
}

void DirectLight::emitters(const Receiver& at, const Lattice<3>& places, std::uint32_t first, std::uint32_t n, Flux& to) const {
  if (tree_.empty()) return;
  thread_local std::vector<EmitterTree::Choice> choices;
  choices.clear();
  for (std::uint32_t i = 0; i < n; ++i) choices.push_back({.u = places[first + i][0], .index = first + i});
  tree_.choose(at, choices);
  for (const auto& c : choices) {
    if (c.emitter == EmitterTree::none) continue;
    auto p = places[c.index];
    emitter(at, c, p[1], p[2], to);
  }
}

void DirectLight::emitter(const Receiver& at, const EmitterTree::Choice& choice, double u, double v, Flux& to) const {
  const Emitter& e = world_.emitters()[choice.emitter];
  double root = std::sqrt(u), b1 = root * (1 - v), b2 = root * v;
  V3 target = e.at(b1, b2), across = cross(e.edge1, e.edge2);
  V3 way = target - at.start;
  double d2 = dot(way, way), leaving = -dot(across, way);  // cosine * distance * twice the area
  if (e.both_sides) leaving = std::fabs(leaving);
  if (!(leaving > 0) || !(d2 > 0)) return;
  double d = std::sqrt(d2), arriving = dot(at.normal, way) / d;
  if (!(arriving > 0) || !(dot(at.face, way) > 0)) return;
  // By solid angle: probability / area * distance^2 / cosine.
  double density = choice.probability * 2 * d2 * d / leaving;
  double weight = arriving / (density + arriving / pi);
  V3 side = unit(dot(across, way) < 0 ? across : -across);
  V3 end = world_.off_surface(target, side) - at.start;
  double distance = length(end);
  Ray ray{at.start, (1 / distance) * end};
  distance *= 1 - 0x1p-19;           // the emitter must not stand before itself by rounding
  double through = world_.transmittance(ray, distance);
  if (through > 0) to.add(through * weight * world_.radiance(e, b1, b2), ray.direction);
}

double DirectLight::gather_weight(const Receiver& from, const Ray& ray, const Hit& hit) const {
  auto id = world_.emitter_of(hit.use, hit.element);
  if (!id) return 1;
  const Emitter& e = world_.emitters()[*id];
  double leaving = std::fabs(dot(cross(e.edge1, e.edge2), ray.direction));  // cosine * twice the area
  double arriving = dot(from.normal, ray.direction) / pi;
  if (!(leaving > 0) || !(arriving > 0)) return 1;
  double density = tree_.probability(from, *id) * 2 * hit.distance * hit.distance / leaving;
  return arriving / (density + arriving);
}

}  // namespace wrlkit::light
