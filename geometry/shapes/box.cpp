// Box (ISO/IEC 14772-1, 6.7): six quadrilaterals, the whole texture on each.
#include <algorithm>
#include <cmath>

#include "geometry/shapes/face_writer.h"
#include "geometry/shapes/shapes.h"
#include "scenegraph/nodes.h"

namespace wrlkit {
namespace {

// The directions in which S and T grow on a face: what is right and up in the picture for a viewer looking from
// outside. Their cross product is the normal. Up on the top is -Z, on the bottom +Z, elsewhere +Y.
struct BoxFace {
  Vec3 right, up, normal;
};
constexpr BoxFace box_faces[] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
    {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}, {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},  {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
};

double extent(const Vec3& size, const Vec3& direction) {
  return size[0] * std::abs(direction[0]) + size[1] * std::abs(direction[1]) + size[2] * std::abs(direction[2]);
}

// Number of the corner of the box that lies on the positive side of X (1), Y (2), Z (4).
std::uint32_t box_corner(const BoxFace& f, double s, double t) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i) bits |= (f.normal[i] + s * f.right[i] + t * f.up[i] > 0 ? 1u : 0u) << i;
  return bits;
}

}  // namespace

void make_box(MeshJob& job, const Tessellation&) {
  Vec3 size = job.scene.get(job.geometry, nodes::box::size);
  for (double& v : size) v = std::abs(v);
  FaceWriter out(job.mesh);
  const bool finite = std::isfinite(size[0] + size[1] + size[2]);
  if (!finite || std::ranges::count(size, 0.0) > 1) return report_no_surface(job, "its size is zero or not finite");

  for (std::uint32_t i = 0; i < 8; ++i)
    out.position(i & 1 ? size[0] / 2 : -size[0] / 2, i & 2 ? size[1] / 2 : -size[1] / 2,
                 i & 4 ? size[2] / 2 : -size[2] / 2);
  constexpr double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (auto [s, t] : square) out.texcoord(s, t);
  for (const auto& f : box_faces) {
    if (extent(size, f.right) == 0 || extent(size, f.up) == 0)
      continue;  // a Box without thickness is a plate of two faces
    auto normal = out.normal(f.normal[0], f.normal[1], f.normal[2]);
    for (std::uint32_t k = 0; k < 4; ++k)
      out.corner(box_corner(f, 2 * square[k][0] - 1, 2 * square[k][1] - 1), normal, k);
    out.end_face();
  }
}

}  // namespace wrlkit
