// Sphere (ISO/IEC 14772-1, 6.43): meridians from the back (-Z) counterclockwise, parallels at equal angles; triangles
// at the poles. The texture covers it with S by longitude and T by latitude, the seam at the back.
#include <algorithm>
#include <cmath>

#include "geometry/shapes/circle.h"
#include "geometry/shapes/face_writer.h"
#include "geometry/shapes/shapes.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

// n segments around, m = n / 2 from pole to pole, so that one circle is both the parallels and the profile. Positions
// and normals have the same numbers: 0 is the south pole, then m - 1 rings of n, then the north pole. Texture
// coordinates: n + 1 on each ring, and one for each triangle at the poles.
class SphereWriter {
 public:
  SphereWriter(MeshJob& job, int n)
      : out_(job.mesh), scratch_(job.scratch), n_(static_cast<std::uint32_t>(n)), m_(n_ / 2) {}

  void write(double radius) {
    write_points(radius);
    write_texcoords();
    for (std::uint32_t k = 0; k < n_; ++k) {
      const auto south = texcoord(m_ - 1, n_) + 1 + k, north = south + n_;
      face({{0, south}, ring(1, k + 1), ring(1, k)});
      for (std::uint32_t j = 1; j + 1 < m_; ++j) face({ring(j, k), ring(j, k + 1), ring(j + 1, k + 1), ring(j + 1, k)});
      face({ring(m_ - 1, k), ring(m_ - 1, k + 1), {(m_ - 1) * n_ + 1, north}});
    }
    out_.finish();
  }

 private:
  struct Corner {
    std::uint32_t point, texcoord;
  };

  std::uint32_t texcoord(std::uint32_t j, std::uint32_t k) const { return (j - 1) * (n_ + 1) + k; }
  Corner ring(std::uint32_t j, std::uint32_t k) const { return {(j - 1) * n_ + 1 + k % n_, texcoord(j, k)}; }

  void face(std::initializer_list<Corner> corners) {
    for (auto c : corners) out_.corner(c.point, c.point, c.texcoord);
    out_.end_face();
  }

  void point(double radius, const Vec3& p) {
    out_.position(radius * p[0], radius * p[1], radius * p[2]);
    out_.normal(p[0], p[1], p[2]);
  }

  void write_points(double radius) {
    auto &x = scratch_.x, &z = scratch_.y;
    unit_circle(static_cast<int>(n_), x, z);
    point(radius, {0, -1, 0});
    for (std::uint32_t j = 1; j < m_; ++j)
      for (std::uint32_t k = 0; k < n_; ++k) point(radius, {-x[j] * x[k], z[j], -x[j] * z[k]});
    point(radius, {0, 1, 0});
  }

  void write_texcoords() {
    for (std::uint32_t j = 1; j < m_; ++j)
      for (std::uint32_t k = 0; k <= n_; ++k) out_.texcoord(double(k) / n_, double(j) / m_);
    for (double pole : {0.0, 1.0})
      for (std::uint32_t k = 0; k < n_; ++k) out_.texcoord((k + 0.5) / n_, pole);
  }

  FaceWriter out_;
  MeshScratch& scratch_;
  std::uint32_t n_, m_;
};

}  // namespace

void make_sphere(MeshJob& job, const Tessellation& options) {
  const double radius = std::abs(job.scene.get(job.geometry, nodes::sphere::radius));
  if (!(radius > 0) || !std::isfinite(radius)) return report_no_surface(job, "its size is zero or not finite");
  const int n = circle_segments(radius, options);
  SphereWriter(job, std::max(4, n + n % 2)).write(radius);
}

}  // namespace wrlkit
