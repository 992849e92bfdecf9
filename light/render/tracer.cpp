#include "light/render/tracer.h"

#include <algorithm>

namespace wrlkit::drawing {
namespace {

/// Strokes as wide as some pixels of the screen. They lie a pixel nearer to the eye than they are, so that a line on a
/// surface is in front of it.
class ScreenPen : public Pen {
 public:
  ScreenPen(const Camera& camera, const TracerOptions& options) : camera_(camera), options_(options) {}

  std::array<Dot, 2> line(const V3& from, const V3& to, double by) const override {
    V3 a = from, b = to;
    double da = camera_.project(a).z, db = camera_.project(b).z, nearest = 1e-4 * std::max(da, db);
    // A line that passes the eye is cut there: its width would be negative behind.
    if (da < nearest && db > 0) a = mix(b, a, (db - nearest) / (db - da));
    if (db < nearest && da > 0) b = mix(a, b, (da - nearest) / (da - db));
    return {dot_at(a, by * options_.line_width), dot_at(b, by * options_.line_width)};
  }
  Dot point(const V3& p, double by) const override { return dot_at(p, by * options_.point_size); }

 private:
  Dot dot_at(const V3& p, double pixels) const {
    return {mix(p, camera_.eye, camera_.pixel()), 0.5 * pixels * camera_.pixel() * camera_.project(p).z};
  }

  const Camera& camera_;
  const TracerOptions& options_;
};

RayScene make_scene(const Stage& stage, const MeshPool& meshes, std::span<const std::uint32_t> mesh_of,
                    const Camera& camera, const TracerOptions& options, Diagnostics& diag) {
  ScreenPen pen(camera, options);
  return {stage,
          meshes,
          mesh_of,
          {.cull = options.cull, .all_flat = options.all_flat, .pen = &pen, .widths = options.widths},
          diag};
}

}  // namespace

Tracer::Tracer(const Stage& stage, const MeshPool& meshes, std::span<const std::uint32_t> mesh_of, const Camera& camera,
               const TracerOptions& options, Diagnostics& diag)
    : scene_(make_scene(stage, meshes, mesh_of, camera, options, diag)) {}

}  // namespace wrlkit::drawing
