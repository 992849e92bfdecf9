// Cylinder (ISO/IEC 14772-1, 6.14). The texture wraps around the side with its seam at the back, in the X = 0 plane.
#include <cmath>

#include "geometry/shapes/caps.h"
#include "geometry/shapes/circle.h"
#include "geometry/shapes/shapes.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

// Quadrilaterals between the lower ring (positions 0 .. n-1) and the upper one (n .. 2n-1).
void write_side(FaceWriter& out, std::span<const double> x, std::span<const double> z) {
  const auto n = static_cast<std::uint32_t>(x.size() - 1);
  for (std::uint32_t k = 0; k < n; ++k) out.normal(x[k], 0, z[k]);
  for (std::uint32_t k = 0; k <= n; ++k) {
    out.texcoord(double(k) / n, 0);
    out.texcoord(double(k) / n, 1);
  }
  for (std::uint32_t k = 0; k < n; ++k) {
    const std::uint32_t next = (k + 1) % n, t = 2 * k;
    out.corner(k, k, t);
    out.corner(next, next, t + 2);
    out.corner(n + next, next, t + 3);
    out.corner(n + k, k, t + 1);
    out.end_face();
  }
}

}  // namespace

void make_cylinder(MeshJob& job, const Tessellation& options) {
  namespace fields = nodes::cylinder;
  const double radius = std::abs(job.scene.get(job.geometry, fields::radius));
  const double height = std::abs(job.scene.get(job.geometry, fields::height));
  FaceWriter out(job.mesh);
  if (!(radius > 0) || !std::isfinite(radius + height)) return report_no_surface(job, "its size is zero or not finite");
  const bool side = job.scene.get(job.geometry, fields::side) && height > 0;
  const bool top = job.scene.get(job.geometry, fields::top), bottom = job.scene.get(job.geometry, fields::bottom);
  if (!side && !top && !bottom) return report_no_surface(job, "none of its parts is drawn");

  auto &x = job.scratch.x, &z = job.scratch.y;
  const int n = circle_segments(radius, options, job.scene.get(job.geometry, fields::segments));
  unit_circle(n, x, z);
  for (double y : {-height / 2, height / 2})
    for (int k = 0; k < n; ++k) out.position(radius * x[k], y, radius * z[k]);
  if (side) write_side(out, x, z);
  if (top) write_cap(out, {x, z, static_cast<std::uint32_t>(n), true});
  if (bottom) write_cap(out, {x, z, 0, false});
  out.finish();
}

}  // namespace wrlkit
