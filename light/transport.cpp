#include "light/transport.h"

#include <utility>

namespace wrlkit::light {
namespace {

constexpr int deepest = 512;       // reflections; what then is left out is less than 0.6 %
constexpr int certain = 3;         // reflections that are followed whatever they bring
constexpr double survivors = 0.5;  // of light beyond these, where there is no cell: narrow gaps would keep it for ever
constexpr int lamp_rays = 2;

}  // namespace

bool see_one_another(const LightWorld& world, const Receiver& a, const Receiver& b) {
  const double height = 0.25 * length(b.start - a.start);
  const V3 from = a.start + height * a.face, way = b.start + height * b.face - from;
  const double distance = length(way);
  const auto is_free = [&](const V3& start, const V3& direction, double to) {
    return !(to > 0) || world.transmittance({start, direction}, to) > 0;
  };
  return is_free(a.start, a.face, height) && is_free(b.start, b.face, height) &&
         is_free(from, (1 / distance) * way, distance);
}

int Transport::facing(const V3& normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  if (x >= y && x >= z) return normal.x < 0 ? 0 : 1;
  if (y >= z) return normal.y < 0 ? 2 : 3;
  return normal.z < 0 ? 4 : 5;
}

Arriving Transport::along(const Receiver& at, const Ray& ray, RandomStream& random, int depth,
                          bool all_emitters) const {
  Arriving out;
  bool first = true;
  auto meet = [&](const Hit& hit, const SurfacePoint& s, double part) {
    // Behind a pane of glass, too, there are backs; they do not say where the ray starts. And in a glass nobody is
    // hidden.
    out.from_inside |= std::exchange(first, false) && s.inside && s.alpha >= 1;
    if (mean(s.emission) > 0 && !(all_emitters && direct_.is_emitter(hit)))
      out.direct += part * direct_.gather_weight(at, ray, hit) * s.emission;
    if (mean(s.albedo) > 0) out.reflected += (part / pi) * (s.albedo * irradiance(ray, hit, s, random, depth + 1));
  };
  const double open = depth == 0 ? each_layer(ray, meet) : one_layer(ray, random, meet);
  if (open > 0 && world_.has_sky()) out.direct += open * world_.sky(ray.direction);
  return out;
}

/// What a surface reflects to whoever sees it, by path tracing.
V3 Transport::shown(const Hit& hit, const SurfacePoint& s, RandomStream& random, const FirstChoices& first) const {
  if (!(mean(s.albedo) > 0)) return {};
  return (1 / pi) * (s.albedo * followed(receiver_at(hit, s), s.albedo, random, 1, &first));
}

const IrradianceCache::Cell* Transport::cell_at(const Ray& ray, const Hit& hit, const SurfacePoint& s,
                                                int larger) const {
  const IrradianceCache::RayEnd end{ray.at(hit.distance), s.face, world_.stage().uses[hit.use].lights, hit.distance};
  if (const auto* own = cache_->find(end)) return own;
  const auto* cell = cache_->find_larger(end, larger);
  return cell && see_one_another(world_, receiver_at(hit, s), cell->place) ? cell : nullptr;
}

V3 Transport::irradiance(const Ray& ray, const Hit& hit, const SurfacePoint& s, RandomStream& random, int depth) const {
  if (cache_) {
    const int larger = depth <= 1 ? 0
                       : depth <= certain
                           ? 2
                           : IrradianceCache::levels;  // the further back, the less a cell's size is seen
    if (const IrradianceCache::Cell* cell = cell_at(ray, hit, s, larger)) return cell->irradiance();
  }
  return followed(receiver_at(hit, s), s.albedo, random, depth);
}

/// An estimate from one more ray in a cosine direction and one to the emitters.
V3 Transport::followed(const Receiver& at, const V3& albedo, RandomStream& random, int depth,
                       const FirstChoices* first) const {
  Flux f;
  direct_.lamps(at, lamp_rays, random, f);
  direct_.emitters(at, first ? first->places : Lattice<3>(random.bits()), first ? first->ray : 0, 1, f);
  double survival = depth <= certain ? 1 : std::max({albedo.x, albedo.y, albedo.z});
  if (cache_ && depth > certain) survival = std::min(survival, survivors);
  if (depth == deepest || random.next() >= survival) return f.sum;
  const auto [u, v] = first ? first->directions[first->ray] : std::array{random.next(), random.next()};
  const V3 direction = cosine_direction(at.normal, u, v);
  if (!(dot(direction, at.face) > 0)) return f.sum;
  Arriving more = along(at, {at.start, direction}, random, depth);
  return f.sum + (pi / survival) * (more.direct + more.reflected);
}

}  // namespace wrlkit::light
