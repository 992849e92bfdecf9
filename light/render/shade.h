// The colour that a ray brings: what it meets, lit by the lights that reach it, through what is transparent, to the
// sky.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "light/render/background.h"
#include "light/render/camera.h"
#include "light/render/dashes.h"
#include "light/render/fog.h"
#include "light/render/light.h"
#include "light/render/mesh_pool.h"
#include "light/render/surface.h"
#include "light/render/tracer.h"

namespace wrlkit::drawing {

/// Everything that is drawn, side by side: stage.uses[i] is the mesh mesh_of[i] with the surface surface_of[i].
struct Drawing {
  const Stage& stage;
  const MeshPool& meshes;
  const Surfaces& surfaces;
  std::span<const std::uint32_t> mesh_of, surface_of;
};

/// What lies where a ray meets a triangle.
struct Spot {
  V3 position;  // world
  V3 face;      // normal of the triangle, world, as long as twice its area
  V3 normal;    // unit, interpolated, on the side of the viewer
};

/// How a triangle is seen.
struct Seen {
  double area;    // twice that of the triangle, in the world
  double facing;  // cosine between it and the ray
};

class Shader {
 public:
  Shader(const Scene& scene, const Drawing& drawing, const Tracer& tracer, const Camera& camera, const Sky& sky,
         bool headlight);

  /// The colour of a place in the picture, each component in [0, 1].
  V3 color(double px, double py) const;

 private:
  Texel shade(const Ray& ray, const Hit& hit) const;
  /// With the lines of its FillProperties.
  Texel hatched(const Surface&, const Ray&, const Hit&, const Texel& below) const;
  Texel shade_face(const Ray& ray, const Hit& hit, const Surface& surface) const;
  /// What the further pictures of a material change.
  struct Further {
    double ambient;
    V3 emissive;
  };
  void further_pictures(const Surface&, const PooledMesh&, const Hit&, const Seen&, V3& normal, Further&) const;
  V3 light(const Surface& surface, const V3& base, const Further&, const LitPoint& at, std::uint32_t scope) const;

  const Drawing& drawing_;
  const Tracer& tracer_;
  const Camera& camera_;
  const Sky& sky_;
  Fog fog_;
  Dashes dashes_;
  std::optional<Light> headlight_;
  std::vector<Light> everywhere_;             // PointLights and SpotLights
  std::vector<std::optional<Light>> scoped_;  // by LightScope
};

/// Position and normals of a hit on a triangle.
Spot spot_at(const Drawing& drawing, const Ray& ray, const Hit& hit);
/// What the surface's picture shows there; none without one.
std::optional<Texel> texel_of(const Drawing& drawing, const Surface& surface, const Hit& hit, const Camera& camera,
                              const Seen& seen);

}  // namespace wrlkit::drawing
