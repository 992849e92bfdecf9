// What a ray meets first: the one place that knows Embree.
//
// Small meshes, and those used once, are put into the world as they are, all together; a large mesh that is used again is
// put in once and instanced. Lines and points are ribbons and discs that face the camera and are as wide as a line of the
// screen there, so that they hide and are hidden like everything else.
#pragma once
#include <memory>
#include <span>

#include "passes/render/camera.h"
#include "passes/render/mesh_pool.h"
#include "passes/render/stage.h"
#include "scenegraph/diagnostics.h"

namespace wrlkit::drawing {

struct Ray {
  V3 origin, direction;  // world; the direction is unit
};

struct Hit {
  double distance = 0;
  std::uint32_t use = 0;      // into Stage::uses
  std::uint32_t element = 0;  // of the mesh: triangle, segment or point
  double weights[3] = {1, 0, 0};  // of the corners of the element
};

/// How things are put before the rays.
struct TracerOptions {
  bool cull = true;           // what is behind a `solid` surface's face is seen through it
  double line_width = 1.5;    // pixels
  double point_size = 2;
  std::size_t all_flat = 8'000'000;  // up to so many elements nothing is instanced: rays are faster then
};

class Tracer {
 public:
  /// `mesh_of[i]` is the mesh of stage.uses[i]. The first three must outlive the tracer.
  Tracer(const Stage& stage, const MeshPool& meshes, std::span<const std::uint32_t> mesh_of, const Camera& camera,
         const TracerOptions& options, Diagnostics& diag);
  ~Tracer();

  /// The nearest thing beyond `after`, strictly: the next call with the distance of a hit gives what lies behind it. Of
  /// surfaces at the same distance it is the one that stands first in the file. Any number of threads may ask.
  bool nearest(const Ray& ray, double after, Hit& hit) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace wrlkit::drawing
