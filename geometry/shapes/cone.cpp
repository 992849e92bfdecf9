// Cone (ISO/IEC 14772-1, 6.11). The side is triangles; each has a corner of its own at the apex, with the normal and
// the texture coordinate of the triangle's middle, so that the shading does not depend on a normal that the apex has
// not.
#include <cmath>

#include "geometry/shapes/caps.h"
#include "geometry/shapes/circle.h"
#include "geometry/shapes/shapes.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

struct Profile {
  double radius, height;
};

// The ring is positions 0 .. n-1, the apex is n. `x` and `z` have 2n + 1 points: those of the ring and those halfway.
void write_side(FaceWriter& out, Profile p, std::span<const double> x, std::span<const double> z) {
  const auto n = static_cast<std::uint32_t>(x.size() - 1) / 2;
  const double slant = std::hypot(p.radius, p.height), outward = p.height / slant, upward = p.radius / slant;
  for (std::uint32_t k = 0; k < 2 * n; ++k) out.normal(outward * x[k], upward, outward * z[k]);
  for (std::uint32_t k = 0; k <= 2 * n; ++k) out.texcoord(0.5 * k / n, k % 2);
  for (std::uint32_t k = 0; k < n; ++k) {
    out.corner(k, 2 * k, 2 * k);
    out.corner((k + 1) % n, (2 * k + 2) % (2 * n), 2 * k + 2);
    out.corner(n, 2 * k + 1, 2 * k + 1);
    out.end_face();
  }
}

// Every second point.
void keep_ring(std::vector<double>& v) {
  for (std::size_t k = 0; 2 * k < v.size(); ++k) v[k] = v[2 * k];
  v.resize(v.size() / 2 + 1);
}

}  // namespace

void make_cone(MeshJob& job, const Tessellation& options) {
  namespace fields = nodes::cone;
  const Profile p{std::abs(job.scene.get(job.geometry, fields::bottomRadius)),
                  std::abs(job.scene.get(job.geometry, fields::height))};
  FaceWriter out(job.mesh);
  if (!(p.radius > 0) || !std::isfinite(p.radius + p.height))
    return report_no_surface(job, "its size is zero or not finite");
  const bool side = job.scene.get(job.geometry, fields::side), bottom = job.scene.get(job.geometry, fields::bottom);
  if (!side && !bottom) return report_no_surface(job, "none of its parts is drawn");

  auto &x = job.scratch.x, &z = job.scratch.y;
  const int n = circle_segments(p.radius, options, job.scene.get(job.geometry, fields::segments));
  unit_circle(2 * n, x, z);
  for (int k = 0; k < n; ++k) out.position(p.radius * x[2 * k], -p.height / 2, p.radius * z[2 * k]);
  out.position(0, p.height / 2, 0);
  if (side) write_side(out, p, x, z);
  keep_ring(x);
  keep_ring(z);
  if (bottom) write_cap(out, {x, z, 0, false});
  out.finish();
}

}  // namespace wrlkit
