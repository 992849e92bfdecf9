// Writes baked light into the scene: pictures, places in them, and which Shape has which.
//
//   after    Shape { appearance Appearance { ... lightmap DEF L ImageTexture { url "wrlkit:lightmap_0.png" }
//                                            lightmapTransform TextureTransform { ... } lightmapScale 2.5 }
//                    geometry IndexedFaceSet { ... lightCoord TextureCoordinate { ... } lightCoordIndex [ ... ] } }
#pragma once
#include <string>
#include <vector>

#include "passes/lightmap/bake.h"

namespace wrlkit::bake {

struct StoreOptions {
  std::string extension = "png";  // of the pictures
  bool exr = false;               // the light as it is beside them, linear and not scaled
};

/// The geometry of each part becomes an IndexedFaceSet of triangles with lightCoord. The Appearance of each Shape gets the
/// lightmap of its page; one that Shapes with different lightmaps share is copied. lightmapScale is the same everywhere: as
/// much as keeps all but the brightest thousandth of the texels below white. Pictures go to ctx.resources.
void store(Scene& scene, std::vector<Part>& parts, const Layout& layout, const drawing::Stage& stage, std::vector<BakedPage>& pages,
           const StoreOptions& options, PassContext& ctx);

}  // namespace wrlkit::bake
