#include "light/transport.h"

#include <utility>

namespace wrlkit::light {
namespace {

constexpr int deepest = 512;       // reflections; what then is left out is less than 0.6 %
constexpr int certain = 3;         // reflections that are followed whatever they bring
constexpr double survivors = 0.5;  // of light beyond these, where there is no cell: narrow gaps would keep it for ever
constexpr int lamp_rays = 2;

}  // namespace

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

V3 Transport::seen(const Ray& ray, RandomStream& random, const std::optional<V3>& background) const {
  V3 sum;
  const double open = each_layer(ray, [&](const Hit& hit, SurfacePoint& s, double part) {
    if (s.inside)
      s.alpha = 0;
    else
      sum += part * (s.emission + (1 / pi) * (s.albedo * irradiance(ray, hit, s, random, 1)));
  });
  return open > 0 ? sum + open * (background         ? *background
                                  : world_.has_sky() ? world_.sky(ray.direction)
                                                     : V3(0))
                  : sum;
}

V3 Transport::irradiance(const Ray& ray, const Hit& hit, const SurfacePoint& s, RandomStream& random, int depth) const {
  if (cache_) {
    const int larger = depth <= 1 ? 0
                       : depth <= certain
                           ? 2
                           : IrradianceCache::levels;  // the further back, the less a cell's size is seen
    const IrradianceCache::Cell* cell =
        cache_->find({ray.at(hit.distance), s.face, world_.stage().uses[hit.use].lights, hit.distance}, larger);
    if (cell) return cell->irradiance();
  }
  return followed(receiver_at(hit, s), s.albedo, random, depth);
}

/// An estimate from one more ray in a cosine direction and one to the emitters.
V3 Transport::followed(const Receiver& at, const V3& albedo, RandomStream& random, int depth) const {
  Flux f;
  direct_.lamps(at, lamp_rays, random, f);
  direct_.emitters(at, Lattice<3>(random.bits()), 0, 1, f);
  double survival = depth <= certain ? 1 : std::max({albedo.x, albedo.y, albedo.z});
  if (cache_ && depth > certain) survival = std::min(survival, survivors);
  if (depth == deepest || random.next() >= survival) return f.sum;
  double u = random.next(), v = random.next();
  V3 direction = cosine_direction(at.normal, u, v);
  if (!(dot(direction, at.face) > 0)) return f.sum;
  Arriving more = along(at, {at.start, direction}, random, depth);
  return f.sum + (pi / survival) * (more.direct + more.reflected);
}

}  // namespace wrlkit::light
