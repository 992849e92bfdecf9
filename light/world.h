// The world as light sees it: what surfaces reflect, let through and emit, the lights, the sky, and what a ray meets.
// All in linear RGB; docs/lighting.md says how VRML's colours become radiance.
//
// Geometry that is used again is there once, so memory grows with the uses and the triangles of the file, not with
// their product.
#pragma once
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/diagnostics.h"
#include "geometry/mesh.h"
#include "light/color.h"
#include "light/lamp_fall.h"
#include "light/render/background.h"
#include "light/render/light.h"
#include "light/render/mesh_pool.h"
#include "light/render/ray_scene.h"
#include "light/render/stage.h"
#include "light/render/surface.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit::light {

using drawing::Hit;
using drawing::Ray;

struct LightOptions {
  enum class Sky : std::uint8_t { background, constant, none };

  double emission = 1;  // factor for the light that emissiveColor gives off
  LampFall lamps = LampFall::as_written;
  Sky sky = Sky::background;
  V3 sky_color{1};                        // constant: radiance, linear
  std::optional<drawing::Pose> viewer{};  // Billboards turn there; none: they stand as they are
  drawing::LevelOf level_of{};            // of LODs; none: the first
  std::size_t all_flat =
      2'000'000;  // up to this many triangles nothing is instanced: some 100 bytes each, and faster rays
};

/// A place on a surface, seen from one side.
struct SurfacePoint {
  V3 face;              // normal of the triangle; world, unit, on the side that is seen
  V3 albedo, emission;  // reflectance and radiance there
  double alpha = 1;     // how much of what comes is met; the rest passes
  bool inside = false;  // it is the back of a `solid` face: who sees it is within something
};

/// A PointLight, SpotLight or DirectionalLight that shines.
struct Lamp {
  drawing::Light light;
  V3 irradiance;  // where it falls perpendicularly with strength 1
};

/// A triangle that emits and is chosen as a target of rays.
struct Emitter {
  V3 corner, edge1, edge2;  // world
  V3 radiance;              // at its middle
  std::uint32_t use, element;
  bool both_sides;
  bool turned;  // it shines to the side where its corners run clockwise

  V3 at(double u, double v) const { return corner + u * edge1 + v * edge2; }
  /// Its normal, on the side that shines; as long as twice its area.
  V3 across() const { return turned ? cross(edge2, edge1) : cross(edge1, edge2); }
  double area() const { return 0.5 * length(across()); }
};

class LightWorld {
 public:
  /// The scene is an expanded one; of Switch and LOD the shown children count. `resources` may be null. Costs O(its
  /// triangles), n log n for the hierarchy over them.
  LightWorld(const Scene& scene, const MeshSource& source, Resources* resources, const LightOptions& options,
             Diagnostics& diag);
  LightWorld(const LightWorld&) = delete;

  /// The entries stand as light/render/stage.h and mesh_pool.h have them: stage().uses[i] shows meshes()[mesh_of()[i]].
  const drawing::Stage& stage() const { return stage_; }
  const drawing::MeshPool& meshes() const { return pool_; }
  std::span<const std::uint32_t> mesh_of() const { return mesh_of_; }

  /// The nearest surface beyond `after`, strictly. Where triangles coincide it is the one that faces the ray.
  bool nearest(const Ray& ray, double after, Hit& hit) const { return rays_->nearest(ray, after, hit); }
  /// The surface at a hit on the side that was hit. The back of a `solid` face is black.
  SurfacePoint surface(const Hit& hit) const;
  /// Where a hit lies in the world, as exactly as the mesh has it, and the normal for shading on the side of `face`,
  /// which is the hit's.
  V3 position(const Hit& hit) const { return hit_point(hit).position; }
  V3 normal(const Hit& hit, const V3& face) const;
  V3 off_surface(const Hit& hit, const V3& face) const {
    const HitPoint p = hit_point(hit);
    return off_surface(p.position, face, p.extent);
  }
  /// A use is a closed surface around some room whose inner side nobody sees: it counts as `solid` TRUE from then on,
  /// and who sees its back is within it even where it touches the front of another one. `inside_out`: its fronts are
  /// the inner side. What it emits goes outwards only.
  void seal(std::uint32_t use, bool inside_out);
  /// All of a use reflects, emits and lets through alike.
  bool is_plain(std::uint32_t use) const { return facts_[use].plain; }
  /// Some of a use may be transparent.
  bool is_clear(std::uint32_t use) const { return facts_[use].clear; }
  /// Whether a place lies within sealed surfaces that hide it: a ray from there leaves more of them than it enters. As
  /// many nearest() as there are surfaces on its way, 64 at the most.
  bool encloses(const Ray& from) const;
  /// Around a use, in the world.
  Box box_of(std::uint32_t use) const;
  /// Whether a PointLight or SpotLight is in a box, widened by so much of its diagonal.
  bool holds_lamp(const Box& box, double margin) const;
  /// It shines and has a light node inside: the glass of a lamp. To VRML light nodes it is not in the way.
  bool is_bulb(std::uint32_t use) const { return facts_[use].bulb; }
  /// What of the light passes along so much of a ray: 0 when something opaque stands there.
  double transmittance(const Ray& ray, double distance) const { return passing(ray, distance, false); }
  /// The same of the light of a light node, which bulbs let through, and which is not within a face by rounding: lamps
  /// often stand in the plane of a ceiling.
  double lamp_transmittance(const Ray& ray, double distance) const {
    return passing(ray, distance - radius() / (1 << 20), true);
  }
  /// Radiance of the sky in a direction of the world.
  V3 sky(const V3& direction) const;
  bool has_sky() const { return has_sky_; }
  /// Or nothing shines, or too little to see the world by: a white sky of radiance 1 is added (docs/lighting.md, "No
  /// light at all").
  bool has_sky_of_its_own() const { return !sky_stands_in_; }
  /// A light node shines, or surfaces light the world as lamps do (docs/lighting.md, "No light at all").
  bool has_lamps() const { return has_lamps_; }

  /// Where a ray that leaves a surface starts: off the face by more than the rounding of coordinates there, and of the
  /// corners of the triangle, of which `extent` is a long side.
  V3 off_surface(const V3& position, const V3& face, double extent) const;

  /// PointLights and SpotLights.
  std::span<const Lamp> lamps() const { return lamps_; }
  /// DirectionalLights: calls f(lamp) for each that lights a scope (Use::lights).
  template <class F>
  void each_directional(std::uint32_t scope, F&& f) const {
    for (; scope; scope = stage_.scopes[scope].parent)
      if (scoped_[scope]) f(*scoped_[scope]);
  }
  /// Triangles that emit, in the order of the file, up to a million. Of further uses the emission is there, too, but
  /// rays find it by chance only.
  std::span<const Emitter> emitters() const { return emitters_; }
  /// The number of the emitter of a triangle; none when it is no emitter.
  std::optional<std::uint32_t> emitter_of(std::uint32_t use, std::uint32_t element) const {
    std::uint32_t first = facts_[use].first_emitter;
    if (first == no_emitter) return {};
    return first + element;
  }
  V3 radiance(const Emitter& e, double u, double v) const;

  /// The middle of the world, and how far any of its coordinates is from there.
  const V3& centre() const { return rays_->centre(); }
  double radius() const { return rays_->radius(); }

 private:
  static constexpr std::uint32_t no_emitter = 0xffffffff;
  bool hides(std::uint32_t use) const { return facts_[use].sealed && !facts_[use].clear; }
  enum class Inner : std::uint8_t { neither, back, front };  // the side of a face that is black, as nobody sees it
  struct UseFacts {
    std::uint32_t surface = 0;
    Inner inner = Inner::neither;
    bool sealed = false;
    std::uint32_t first_emitter = no_emitter;
    bool clear = false;  // some of it may be transparent
    bool plain = false;  // one colour everywhere
    bool bulb = false;
    V3 albedo, emission;  // when it is plain
  };

  struct HitPoint {
    V3 position;
    double extent;
  };
  HitPoint hit_point(const Hit& hit) const;
  void make_facts(const Scene& scene, Resources* resources, Diagnostics& diag);
  void make_lamps(const Scene& scene);
  void find_bulbs();
  double passing(const Ray& ray, double distance, bool through_bulbs) const;
  /// They fall by the square of the distance from now on.
  void spread_lamps();
  void make_sky(const Scene& scene, Resources* resources, Diagnostics& diag);
  /// Whether surfaces that shine as lamps do are light enough for all others.
  bool glow_is_light() const;
  double area_of(std::uint32_t use) const;
  double total_area() const;
  void make_emitters();
  drawing::Texel base(const UseFacts& use, const Hit& hit) const;
  void paint(const UseFacts& use, const Hit& hit, SurfacePoint& to) const;

  LightOptions options_;
  drawing::Stage stage_;
  drawing::MeshPool pool_;
  std::vector<std::uint32_t> mesh_of_;
  std::optional<drawing::Surfaces> surfaces_;
  std::vector<UseFacts> facts_;
  std::vector<Lamp> lamps_;
  std::vector<std::optional<Lamp>> scoped_;  // by LightScope
  std::vector<Emitter> emitters_;
  std::optional<drawing::Sky> background_;
  V3 constant_sky_;
  bool has_sky_ = false, has_lamps_ = false, sky_stands_in_ = false, emits_ = false, has_clear_ = false;
  std::optional<drawing::RayScene> rays_;
};

}  // namespace wrlkit::light
