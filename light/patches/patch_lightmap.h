// From patches to textures: the core of `lightmap{patches=...}` (Lazanyi, 3.2). Each Shape gets one picture, in which
// each side of its flat polygons that has patches is drawn once, with all of them, and texture coordinates for its
// triangles.
#pragma once
#include "light/patches/flat_picture.h"
#include "light/patches/patch_match.h"

namespace wrlkit::light {

struct PatchLightmapOptions {
  PictureOptions picture{.texel = 0};  // texel 0: a quarter of the mean patch
  int most_side = 4096;                // of a picture; texels become larger when it would have more
  bool smooth = false;                 // three colours a patch (smooth_patches.h)
  /// What a white surface would reflect (irradiance / pi) instead of the radiance of the patches: for textures that are
  /// multiplied with the colour of the surface.
  bool without_color = false;
};

/// Of the corners of a triangle, in its own order: s to the right, t upwards, in [0, 1].
using TrianglePlaces = std::array<std::array<float, 2>, 3>;

struct ShapePicture {
  std::uint32_t use = 0;  // into LightWorld::stage().uses
  FloatPicture picture;
  double texel = 0;                         // metres
  std::size_t n_polygons = 0;               // sides of polygons that have patches
  std::vector<TrianglePlaces> front, back;  // of each triangle of the mesh
};

struct PatchLightmap {
  std::vector<ShapePicture> shapes;  // those with patches, in the order of the stage
  std::size_t n_patches = 0, n_orphans = 0;
  std::size_t n_bare = 0;  // triangles of these Shapes without a patch on either side
};

/// A side without patches shows those of the other one; a triangle without any has the mean colour of its Shape.
/// Polygons are triangles of one plane that share edges. O(patches + texels) and O(n log n) of the triangles.
PatchLightmap patch_lightmap(const PatchSet& set, const LightWorld& world, const PatchLightmapOptions& options);

}  // namespace wrlkit::light
