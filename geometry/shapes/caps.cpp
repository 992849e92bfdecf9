#include "geometry/shapes/caps.h"

namespace wrlkit {

void write_cap(FaceWriter& out, const Cap& cap) {
  const auto n = static_cast<std::uint32_t>(cap.x.size() - 1);
  const double up = cap.up ? 1 : -1;
  const auto normal = out.normal(0, up, 0);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t k = cap.up ? i : n - 1 - i;
    out.corner(cap.first + k, normal, out.texcoord((1 + cap.x[k]) / 2, (1 - up * cap.z[k]) / 2));
  }
  out.end_face();
}

}  // namespace wrlkit
