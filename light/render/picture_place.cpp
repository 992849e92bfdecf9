#include "light/render/picture_place.h"

#include <algorithm>
#include <cmath>

namespace wrlkit::drawing {

double PicturePlace::detail(const Texture& picture, const Hit& hit, const Camera& camera, double facing) const {
  double pixels = density * picture.width() * picture.height();
  return pixels > 0 ? hit.distance * camera.sample() * std::sqrt(pixels / std::max(facing, 0.05)) : 1;
}

std::optional<PicturePlace> place_of(const MeshPool& pool, const PooledMesh& m, const Hit& hit, const Stream& stream,
                                     std::size_t first, const TexcoordMap& map, double area) {
  if (first == PooledMesh::absent) return {};
  auto at = interpolate<2>(pool, stream, m, first, hit);
  const float* c[3];
  for (int k = 0; k < 3; ++k) c[k] = pool.value(stream, m, first, hit.element, k);
  double picture =
      std::fabs(double{c[1][0] - c[0][0]} * (c[2][1] - c[0][1]) - double{c[2][0] - c[0][0]} * (c[1][1] - c[0][1]));
  return PicturePlace{map(at[0], at[1]), area > 0 ? picture * std::fabs(map.determinant()) / area : 0};
}

}  // namespace wrlkit::drawing
