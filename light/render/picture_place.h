// Where the place that a ray met lies in a picture, and how fine the picture is there.
#pragma once
#include <array>
#include <optional>

#include "light/render/attributes.h"
#include "light/render/camera.h"

namespace wrlkit::drawing {

/// A place in a picture whose sides are 1 long.
struct PicturePlace {
  std::array<double, 2> at;
  double density = 0;  // area in the picture for each square metre of the world

  /// Pixels of a picture that one sample spans, as Texture::sample wants it, for a surface that is seen at the distance
  /// of the hit; `facing` is the cosine between it and the ray.
  double detail(const Texture&, const Hit&, const Camera&, double facing) const;
};

/// By one of the streams of the pool. `area` is twice that of the triangle in the world. None when the mesh lacks it.
std::optional<PicturePlace> place_of(const MeshPool& pool, const PooledMesh& mesh, const Hit& hit, const Stream& stream,
                                     std::size_t first, const TexcoordMap& map, double area);

}  // namespace wrlkit::drawing
