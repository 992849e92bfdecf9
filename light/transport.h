// What a ray brings back: light that is made where it ends, and light that is reflected there, by the cache where it
// has a cell and by following the light further where not.
#pragma once
#include "base/math/random.h"
#include "light/cache.h"
#include "light/direct.h"

namespace wrlkit::light {

/// Radiance that comes along a ray.
struct Arriving {
  V3 direct;  // from emitters and the sky
  V3 reflected;
  bool from_inside = false;  // the ray met the back of an opaque solid face: its start is within something
};

/// Where the light of what a camera sees is looked for first, for one of many rays of a pixel: together they are spread
/// evenly.
struct FirstChoices {
  Lattice<2> directions;
  Lattice<3> places;  // on emitters
  std::uint32_t ray;

  FirstChoices(std::uint64_t key, std::uint32_t r)
      : directions(random_key(key, 1)), places(random_key(key, 2)), ray(r) {}
};

/// What a camera sees in one direction, one thing behind the other. Neighbours on a surface that is about flat are
/// equal.
struct SeenFace {
  static constexpr std::uint32_t sky = 0xffffffff;

  std::uint32_t layer = 0;  // how many things are in front of it
  std::uint32_t use = sky;  // of its mesh
  int facing = 0;           // the axis that its normal is nearest to, and to which side

  bool operator==(const SeenFace&) const = default;
};

/// Looking from above the surfaces, so that one that is bent a little does not stand in the way.
bool see_one_another(const LightWorld& world, const Receiver& a, const Receiver& b);

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

  /// Calls f(face, part, radiance) for what a camera sees along a ray, one thing behind the other; `part` is its share
  /// of what is seen. The last is the sky, or `background` instead of it. The backs of solid faces are seen through.
  /// `key` is of the pixel, `number` of the ray in it.
  template <class F>
  void each_seen(const Ray& ray, std::uint64_t key, std::uint32_t number, const std::optional<V3>& background,
                 F&& f) const {
    RandomStream random(random_key(key, 0, number));
    std::uint32_t layer = 0;
    const double open = each_layer(ray, [&](const Hit& hit, SurfacePoint& s, double part) {
      if (s.inside) s.alpha = 0;
      if (s.inside || part <= 0) return;
      const SeenFace face{layer, hit.use, facing(s.face)};
      f(face, part, s.emission + shown(hit, s, random, {random_key(key, 1, layer++), number}));
    });
    if (open > 0)
      f(SeenFace{layer}, open, background ? *background : world_.has_sky() ? world_.sky(ray.direction) : V3(0));
  }

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

  /// What the cache knows of a place that a ray met: its cell, or one that is up to `larger` times twice as large and
  /// in sight. Null when there is none.
  const IrradianceCache::Cell* cell_at(const Ray& ray, const Hit& hit, const SurfacePoint& s, int larger) const;

  /// The receiver of the light at a place that a ray met.
  Receiver receiver_at(const Hit& hit, const SurfacePoint& s) const {
    return {world_.off_surface(hit, s.face), s.face, world_.normal(hit, s.face), world_.stage().uses[hit.use].lights};
  }

 private:
  static constexpr int most_layers = 32;

  static int facing(const V3& normal);
  Arriving along(const Receiver& at, const Ray& ray, RandomStream& random, int depth, bool all_emitters = false) const;
  V3 irradiance(const Ray& ray, const Hit& hit, const SurfacePoint& s, RandomStream& random, int depth) const;
  V3 shown(const Hit& hit, const SurfacePoint& s, RandomStream& random, const FirstChoices& first) const;
  V3 followed(const Receiver& at, const V3& albedo, RandomStream& random, int depth,
              const FirstChoices* first = nullptr) const;

  const LightWorld& world_;
  const DirectLight& direct_;
  const IrradianceCache* cache_;
};

}  // namespace wrlkit::light
