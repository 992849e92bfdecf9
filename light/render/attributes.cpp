#include "light/render/attributes.h"

namespace wrlkit::drawing {

std::optional<Texel> vertex_color(const MeshPool& pool, const PooledMesh& m, const Hit& hit) {
  if (m.colors == PooledMesh::absent) return {};
  auto c = interpolate<3>(pool, pool.colors, m, m.colors, hit);
  Texel out{{c[0], c[1], c[2]}, 1};
  if (m.color_width == 4) out.alpha = interpolate<4>(pool, pool.colors, m, m.colors, hit)[3];
  return out;
}

std::optional<Texel> texture_at(const MeshPool& pool, const PooledMesh& m, const Surface& s, const Hit& hit,
                                double detail) {
  if (!s.picture.texture || m.texcoords == PooledMesh::absent) return {};
  auto at = interpolate<2>(pool, pool.texcoords, m, m.texcoords, hit);
  return s.picture.sample(s.texcoords(at[0], at[1]), detail);
}

}  // namespace wrlkit::drawing
