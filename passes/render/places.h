// What a mesh says of the place that a ray met: its colour there, and where it lies in a picture.
#pragma once
#include <array>
#include <optional>

#include "passes/render/camera.h"
#include "passes/render/mesh_pool.h"
#include "passes/render/surface.h"
#include "passes/render/tracer.h"

namespace wrlkit::drawing {

/// The mean of an attribute of a triangle, segment or point at the place that was hit. `first` is the mesh's entry for it.
template <int N>
std::array<double, N> interpolate(const MeshPool& pool, const Stream& s, const PooledMesh& m, std::size_t first, const Hit& hit) {
  std::array<double, N> out{};
  for (int k = 0; k < m.corners_per_element(); ++k) {
    const float* v = pool.value(s, m, first, hit.element, k);
    for (int i = 0; i < N; ++i) out[i] += hit.weights[k] * v[i];
  }
  return out;
}

/// The colour that the geometry gives, RGB or RGBA.
std::optional<Texel> vertex_color(const MeshPool& pool, const PooledMesh& mesh, const Hit& hit);

/// A place in a picture whose sides are 1 long.
struct Place {
  std::array<double, 2> at;
  double density = 0;  // area in the picture for each square metre of the world

  /// Pixels of a picture that one sample spans, as Texture::sample wants it, for a surface that is seen at the distance of
  /// the hit; `facing` is the cosine between it and the ray.
  double detail(const Texture&, const Hit&, const Camera&, double facing) const;
};

/// By one of the streams of the pool. `area` is twice that of the triangle in the world. None when the mesh lacks it.
std::optional<Place> place_of(const MeshPool& pool, const PooledMesh& mesh, const Hit& hit, const Stream& stream, std::size_t first,
                              const TexcoordMap& map, double area);

}  // namespace wrlkit::drawing
