// What the corners of an element say at a place on it: colours, places in the texture, normals.
#pragma once
#include <array>
#include <optional>

#include "light/render/mesh_pool.h"
#include "light/render/ray_scene.h"
#include "light/render/surface.h"

namespace wrlkit::drawing {

/// The mean of an attribute of a triangle, segment or point at the place that was hit.
template <int N>
std::array<double, N> interpolate(const MeshPool& pool, const Stream& s, const PooledMesh& m, std::size_t first,
                                  const Hit& hit) {
  std::array<double, N> out{};
  for (int k = 0; k < m.corners_per_element(); ++k) {
    const float* v = pool.value(s, m, first, hit.element, k);
    for (int i = 0; i < N; ++i) out[i] += hit.weights[k] * v[i];
  }
  return out;
}

/// The colour that the geometry gives; none when it has none.
std::optional<Texel> vertex_color(const MeshPool& pool, const PooledMesh& m, const Hit& hit);

/// The texture of a surface there; none when it or its coordinates are absent. `detail` is the number of its pixels
/// that one sample spans.
std::optional<Texel> texture_at(const MeshPool& pool, const PooledMesh& m, const Surface& s, const Hit& hit,
                                double detail);

}  // namespace wrlkit::drawing
