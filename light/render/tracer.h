// The rays of a picture: a RayScene in which lines and points are ribbons and discs that face the camera and are as
// wide as a line of the screen there, so that they hide and are hidden like everything else.
#pragma once
#include "light/render/camera.h"
#include "light/render/ray_scene.h"

namespace wrlkit::drawing {

/// How things are put before the rays.
struct TracerOptions {
  bool cull = true;         // what is behind a `solid` surface's face is seen through it
  double line_width = 1.5;  // pixels
  double point_size = 2;
  std::size_t all_flat = RayOptions{}.all_flat;
  std::span<const float> widths = {};  // by use: factors for these widths; may be empty
};

class Tracer {
 public:
  /// `mesh_of[i]` is the mesh of stage.uses[i]. The first three must outlive the tracer.
  Tracer(const Stage& stage, const MeshPool& meshes, std::span<const std::uint32_t> mesh_of, const Camera& camera,
         const TracerOptions& options, Diagnostics& diag);

  /// As RayScene::nearest().
  bool nearest(const Ray& ray, double after, Hit& hit) const { return scene_.nearest(ray, after, hit); }

 private:
  RayScene scene_;
};

}  // namespace wrlkit::drawing
