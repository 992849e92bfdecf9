// Irradiance at points of surfaces: direct light by rays to lamps, emitters and the sky, reflected light by a final
// gather over a coarse radiosity solution. Or, slower and without any bias, by following paths to their end.
#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "light/world.h"

namespace wrlkit::light {

struct IntegratorOptions {
  /// cached: reflected light is looked up where it can be. path: it is followed; the reference.
  enum class Mode : std::uint8_t { cached, path };

  Mode mode = Mode::cached;
  int rays = 64;      // a point, and as many to emitters where there are any
  double cell = 0;    // largest cell of the cache, world units; 0: a tenth of LightWorld::radius()
  double points = 0;  // that will be asked for: the more, the better the cache; 0: as many as it is made for
  std::uint64_t seed = 1;
  int cache = 0;  // 0 or 1: what the one has made of the light says nothing of the other, neither its noise nor where
                  // its cells end
};

/// A point of a surface, on the side of its normals.
struct Point {
  V3 position;      // world
  V3 face, normal;  // of the triangle and for shading; unit
  static constexpr std::uint32_t nowhere = 0xffffffff;
  std::uint32_t use = nowhere;  // into LightWorld::stage().uses: for the DirectionalLights on it; nowhere: none
  double extent = 0;            // of the triangle: a long side
};

using Rgb = std::array<float, 3>;

/// Linear RGB. The radiance that a white surface reflects is irradiance / pi.
struct Irradiance {
  Rgb direct{}, gathered{};  // by rays to lamps and emitters; by rays in all directions: reflected, from the sky, what
                             // of emitters is left
  Rgb direct_variance{}, gathered_variance{};  // of these estimates; upper bounds
  /// Integrals of radiance * cosine * direction, world axes: along[0] goes with x. Together with direct + gathered the
  /// irradiance-weighted spherical harmonics of degree 0 and 1: c00 = 0.282095 E, c1(axis) = 0.488603 along[axis].
  Rgb along[3]{};
  float inside = 0;  // share of the rays that met the back of an opaque solid face: the point lies within something
  std::uint32_t rays = 0;
  bool by_lamp = false;  // a PointLight, SpotLight or DirectionalLight reaches it
};

class Integrator {
 public:
  /// `points` are those that will be asked for, or a fair choice of them: the cache is made for these. The world must
  /// outlive the integrator.
  Integrator(const LightWorld& world, std::span<const Point> points, const IntegratorOptions& options = {});
  ~Integrator();
  Integrator(Integrator&&) noexcept;

  /// out[i] belongs to points[i]; the same bits for any number of threads. `first` is the number of the first point:
  /// asking in pieces gives what asking for all at once gives. Neighbouring points should follow one another.
  std::vector<Irradiance> irradiance(std::span<const Point> points, std::size_t first = 0) const {
    return irradiance(points, first, {0, rays()});
  }

  /// Rays of a point: `rays` of them, after `first` that were asked for before and with which they share a lattice.
  struct Round {
    std::uint32_t first;
    int rays;
    std::span<const std::uint32_t> numbers{};  // of the points, from the first on; empty: 0, 1, 2, ...
  };
  std::vector<Irradiance> irradiance(std::span<const Point> points, std::size_t first, const Round& round) const;

 private:
  int rays() const;
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wrlkit::light
