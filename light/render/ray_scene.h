// What a ray meets first: the one place that knows Embree. The renderer (light/render/tracer.h) and light (light/)
// stand on it.
//
// Small meshes, and those used once, are put into the world as they are, all together; a large mesh that is used again
// is put in once and instanced. Coordinates are in single precision around the centre of the world.
#pragma once
#include <array>
#include <memory>
#include <span>

#include "base/diagnostics.h"
#include "light/render/mesh_pool.h"
#include "light/render/stage.h"

namespace wrlkit::drawing {

struct Ray {
  V3 origin, direction;  // world; the direction is unit

  V3 at(double distance) const { return origin + distance * direction; }
};

struct Hit {
  double distance = 0;
  std::uint32_t use = 0;      // into Stage::uses
  std::uint32_t element = 0;  // of the mesh: triangle, segment or point
  bool back = false;          // the ray comes from behind the triangle
  static constexpr std::uint32_t none = 0xffffffff;
  std::uint32_t leaves =
      none;  // a use of which the ray meets a back at the very same distance, though a front counts as nearer
  double weights[3] = {1, 0, 0};  // of the corners of the element
  V3 across;                      // of a triangle: its normal, world, on the front; of any length
};

/// Lines and points have no width of their own: a pen says how they are drawn.
class Pen {
 public:
  /// A place (world) and how far around it the stroke goes; no stroke there when that is not positive.
  struct Dot {
    V3 at;
    double radius;
  };
  virtual ~Pen() = default;
  /// `by`: a factor for how wide plain ones are.
  virtual std::array<Dot, 2> line(const V3& a, const V3& b, double by) const = 0;
  virtual Dot point(const V3& p, double by) const = 0;
};

/// How things are put before the rays.
struct RayOptions {
  bool cull = true;                  // what is behind a `solid` surface's face is seen through it
  bool fronts_first = false;         // of triangles at one distance those seen from the front count as nearer
  std::size_t all_flat = 8'000'000;  // up to this many elements nothing is instanced: rays are faster then
  const Pen* pen = nullptr;          // none: rays pass lines and points
  std::span<const float> widths;     // by use: of lines and points, in those of plain ones; may be empty
  std::span<const char> clear;       // by use: not in the way of occluded(); may be empty
};

class RayScene {
 public:
  /// `mesh_of[i]` is the mesh of stage.uses[i]. The first three must outlive the scene; what options refer to need not.
  RayScene(const Stage& stage, const MeshPool& meshes, std::span<const std::uint32_t> mesh_of,
           const RayOptions& options, Diagnostics& diag);
  ~RayScene();

  /// The nearest thing beyond `after`, strictly: the next call with the distance of a hit gives what lies behind it. Of
  /// surfaces at the same distance it is the one that stands first in the file. Any number of threads may ask.
  bool nearest(const Ray& ray, double after, Hit& hit) const;

  /// Whether something that is not clear lies between `after` and `before`, whatever side of it. Not slower for
  /// coherence, and faster than nearest().
  bool occluded(const Ray& ray, double after, double before) const;

  /// Whether a use is there. Of several that are one mesh in one place only the first is, and none that has no
  /// triangles.
  bool holds(std::uint32_t use) const;
  /// Of the world; single-precision coordinates are relative to it.
  const V3& centre() const;
  /// No coordinate of the world is further from the centre than this.
  double radius() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wrlkit::drawing
