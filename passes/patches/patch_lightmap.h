// From patches to textures: the core of `lightmap{patches=...}` (Lazanyi, 3.2). Each Shape gets one picture, in which each
// of its flat polygons is drawn once, with all patches that lie in it, and texture coordinates for its triangles.
#pragma once
#include "passes/patches/flat_picture.h"
#include "passes/patches/patch_match.h"

namespace wrlkit::light {

struct PatchLightmapOptions {
  PictureOptions picture{.texel = 0};  // texel 0: a quarter of the mean patch
  int most_side = 4096;              // of a picture; texels become larger when it would have more
  /// What a white surface would reflect (irradiance / pi) instead of the radiance of the patches: for textures that are
  /// multiplied with the colour of the surface.
  bool without_color = false;
};

struct ShapePicture {
  std::uint32_t use = 0;             // into LightWorld::stage().uses
  FloatPicture picture;              // low is without meaning
  double texel = 0;                  // metres
  std::size_t n_polygons = 0;
  /// For each triangle of the mesh and each of its corners, in their own order: s to the right, t upwards, in [0, 1].
  std::vector<std::array<std::array<float, 2>, 3>> texcoords;
};

struct PatchLightmap {
  std::vector<ShapePicture> shapes;  // those with patches, in the order of the stage
  std::size_t n_patches = 0, n_orphans = 0;
};

/// A polygon with patches on its front shows these, one with patches on its back alone shows those: VRML has one texture
/// for both sides. Polygons are triangles of one plane that share edges. O(patches + texels) and O(n log n) of the triangles.
PatchLightmap patch_lightmap(const PatchSet& set, const LightWorld& world, const PatchLightmapOptions& options);

}  // namespace wrlkit::light
