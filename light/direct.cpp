#include "light/direct.h"

#include <algorithm>

#include "light/lambert.h"

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

void DirectLight::lamps(const Receiver& at, int most, RandomStream& random, Flux& to) const {
  thread_local std::vector<Candidate> all;
  all.clear();
  for (const Lamp& l : world_.lamps()) add_candidate(all, l, at);
  world_.each_directional(at.scope, [&](const Lamp& l) { add_candidate(all, l, at); });
  auto shine = [&](const Candidate& c, double times) {
    double through = world_.lamp_transmittance({at.start, c.direction}, c.distance);
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

void DirectLight::emitters(const Receiver& at, const Lattice<3>& places, std::uint32_t first, std::uint32_t n,
                           Flux& to) const {
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

/// None when the place is turned away.
std::optional<DirectLight::Sight> DirectLight::look(const Receiver& at, const Emitter& e, double b1, double b2) const {
  V3 target = e.at(b1, b2), across = e.across();
  V3 way = target - at.start;
  Sight s;
  s.distance2 = dot(way, way);
  s.leaving = -dot(across, way);
  if (e.both_sides) s.leaving = std::fabs(s.leaving);
  if (!(s.leaving > 0) || !(s.distance2 > 0)) return {};
  s.distance = std::sqrt(s.distance2);
  s.arriving = dot(at.normal, way) / s.distance;
  if (!(s.arriving > 0) || !(dot(at.face, way) > 0)) return {};
  V3 side = unit(dot(across, way) < 0 ? across : -across);
  V3 end = world_.off_surface(target, side, length(e.edge1)) - at.start;
  double length_of_ray = length(end);
  s.ray = {at.start, (1 / length_of_ray) * end};
  s.through = world_.transmittance(
      s.ray, length_of_ray * (1 - 0x1p-19));  // the emitter must not stand before itself by rounding
  return s;
}

void DirectLight::emitter(const Receiver& at, const EmitterTree::Choice& choice, double u, double v, Flux& to) const {
  const Emitter& e = world_.emitters()[choice.emitter];
  double root = std::sqrt(u), b1 = root * (1 - v), b2 = root * v;
  auto s = look(at, e, b1, b2);
  if (!s || !(s->through > 0)) return;
  // By solid angle: probability / area * distance^2 / cosine.
  double density = choice.probability * 2 * s->distance2 * s->distance / s->leaving;
  double weight = s->arriving / (density + s->arriving / pi);
  to.add(s->through * weight * world_.radiance(e, b1, b2), s->ray.direction);
}

void DirectLight::all_emitters(const Receiver& at, std::uint64_t key, std::uint32_t first, std::uint32_t n, Flux& to,
                               V3& noise) const {
  const auto emitters = world_.emitters();
  double strength[few], sum = 0;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const Emitter& e = emitters[i];
    const V3 corner[] = {e.corner - at.start, e.corner + e.edge1 - at.start, e.corner + e.edge2 - at.start};
    const bool faces = e.both_sides || dot(e.across(), corner[0]) < 0;
    sum += strength[i] = faces && mean(e.radiance) > 0 ? mean(e.radiance) * irradiance_of(corner, at) : 0;
  }
  if (!(sum > 0)) return;
  // Rays by strength, two at least, so that they tell how they scatter. Emitters of less are drawn for a ray each, by
  // equal steps along the sum of their strengths; those scatter from one another. A whole number of steps, so that
  // where all are seen there is no noise.
  const double enough = 2 * sum / n;
  double faint = 0;
  for (std::size_t i = 0; i < emitters.size(); ++i) faint += strength[i] < enough ? strength[i] : 0;
  const double step = faint / std::max(1.0, std::round(faint * n / sum));
  double next = random_fraction(random_key(key, emitters.size(), first)) * step, n_drawn = 0;
  V3 drawn, drawn_squares, drawn_noise;
  for (std::size_t i = 0; i < emitters.size(); ++i) {
    const V3 full((n / mean(emitters[i].radiance)) * strength[i]);
    if (strength[i] >= enough) {
      const auto rays = [&](std::uint32_t of) {
        return static_cast<std::uint32_t>(std::lround(of * (strength[i] / sum)));
      };
      add_seen(at, emitters[i], full, Lattice<2>(random_key(key, i)), rays(first), rays(n), to, noise);
    } else if (strength[i] > 0) {
      std::uint32_t rays_here = 0;
      for (next -= strength[i]; next < 0; next += step) ++rays_here;
      if (!rays_here) continue;
      const V3 e = add_seen(at, emitters[i], (rays_here * step / strength[i]) * full,
                            Lattice<2>(random_key(key, i, first)), 0, rays_here, to, drawn_noise);
      drawn += e;
      drawn_squares += (1.0 / rays_here) * (e * e);
      n_drawn += rays_here;
    }
  }
  noise += n_drawn < 2 ? drawn_noise
                       : max(V3(), (n_drawn / (n_drawn - 1)) * (drawn_squares - (1 / n_drawn) * (drawn * drawn)));
}

/// `strength` is the irradiance by radiance 1 when nothing stands between. Returns what was added.
V3 DirectLight::add_seen(const Receiver& at, const Emitter& e, const V3& strength, const Lattice<2>& places,
                         std::uint32_t first, std::uint32_t n, Flux& to, V3& noise) const {
  struct Seen {
    V3 light, direction;
    double weight;
  };
  thread_local std::vector<Seen> seen;
  seen.clear();
  double weights = 0;
  V3 sum;
  for (std::uint32_t i = 0; i < n; ++i) {
    auto [u, v] = places[first + i];
    double root = std::sqrt(u), b1 = root * (1 - v), b2 = root * v;
    auto s = look(at, e, b1, b2);
    if (!s) continue;
    const double weight = s->arriving * s->leaving / (s->distance2 * s->distance);
    seen.push_back({s->through > 0 ? s->through * world_.radiance(e, b1, b2) : V3(), s->ray.direction, weight});
    weights += weight;
    sum += weight * seen.back().light;
  }
  if (!(weights > 0)) return {};
  const V3 part = (1 / weights) * sum;
  V3 squares;
  for (const Seen& s : seen) {
    to.add((s.weight / weights) * (strength * s.light), s.direction);
    const V3 off = (s.weight / weights) * (strength * (s.light - part));
    squares += off * off;
  }
  noise += squares;
  return strength * part;
}

double DirectLight::gather_weight(const Receiver& from, const Ray& ray, const Hit& hit) const {
  auto id = world_.emitter_of(hit.use, hit.element);
  if (!id) return 1;
  const Emitter& e = world_.emitters()[*id];
  double leaving = std::fabs(dot(e.across(), ray.direction));  // cosine * twice the area
  double arriving = dot(from.normal, ray.direction) / pi;
  if (!(leaving > 0) || !(arriving > 0)) return 1;
  double density = tree_.probability(from, *id) * 2 * hit.distance * hit.distance / leaving;
  return arriving / (density + arriving);
}

}  // namespace wrlkit::light
