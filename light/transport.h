// What a ray brings back: light that is made where it ends, and light that is reflected there, by the cache where it
// has a cell and by following the light further where not.
#pragma once
#include "light/cache.h"
#include "light/direct.h"

namespace wrlkit::light {

/// Radiance that comes along a ray.
struct Arriving {
  V3 direct;  // from emitters and the sky
  V3 reflected;
  bool from_inside = false;  // the ray met the back of an opaque solid face: its start is within something
};

class Transport {
 public:
  /// Without a cache all light is followed (path tracing).
  Transport(const LightWorld& world, const DirectLight& direct, const IrradianceCache* cache)
      : world_(world), direct_(direct), cache_(cache) {}

  /// What comes to a receiver along a ray of its own that was drawn in a cosine direction. Light of emitters is
  /// weighted for rays to emitters next to it (DirectLight::emitters), or left out (`all_emitters`:
  /// DirectLight::all_emitters).
  Arriving gather(const Receiver& at, const Ray& ray, RandomStream& random, bool all_emitters = false) const {
    return along(at, ray, random, 0, all_emitters);
  }

  /// Radiance that a camera sees along a ray; `background`: instead of the sky. The backs of solid faces let it
  /// through.
  V3 seen(const Ray& ray, RandomStream& random, const std::optional<V3>& background) const;

  /// Calls f(hit, surface, part) for what a ray meets, through what is transparent; `part` is how much of the ray's
  /// light comes from there. An f that sets surface.alpha to 0 lets the ray pass. Returns the part that comes from the
  /// sky.
  template <class F>
  double each_layer(const Ray& ray, F&& f) const {
    constexpr double hidden = 1.0 / 512;
    double through = 1, after = 0;
    Hit hit;
    for (int layer = 0; layer < most_layers; ++layer, after = hit.distance) {
      if (!world_.nearest(ray, after, hit)) return through;
      SurfacePoint s = world_.surface(hit);
      f(hit, s, through * s.alpha);
      through *= 1 - s.alpha;
      if (through < hidden) return 0;
    }
    return 0;
  }

  /// The same through one layer only, by chance: the part of each is how often it is the one. For rays whose light
  /// nobody sees by itself; if these went on from all layers, there would be many times as many after each reflection.
  template <class F>
  double one_layer(const Ray& ray, RandomStream& random, F&& f) const {
    double after = 0;
    Hit hit;
    for (int layer = 0; layer < most_layers; ++layer, after = hit.distance) {
      if (!world_.nearest(ray, after, hit)) return 1;
      SurfacePoint s = world_.surface(hit);
      if (s.alpha < 1 && random.next() >= s.alpha) continue;
      f(hit, s, 1);
      break;
    }
    return 0;
  }

  /// The receiver of the light at a place that a ray met.
  Receiver receiver_at(const Hit& hit, const SurfacePoint& s) const {
    return {world_.off_surface(hit, s.face), s.face, world_.normal(hit, s.face), world_.stage().uses[hit.use].lights};
  }

 private:
  static constexpr int most_layers = 32;

  Arriving along(const Receiver& at, const Ray& ray, RandomStream& random, int depth, bool all_emitters = false) const;
  V3 irradiance(const Ray& ray, const Hit& hit, const SurfacePoint& s, RandomStream& random, int depth) const;
  V3 followed(const Receiver& at, const V3& albedo, RandomStream& random, int depth) const;

  const LightWorld& world_;
  const DirectLight& direct_;
  const IrradianceCache* cache_;
};

}  // namespace wrlkit::light
