// Light from a patch file onto the Shapes of a scene: the pipeline of the seed paper (Lazanyi, 3.2). Each Shape gets a
// picture of its own.
#pragma once
#include "geometry/tessellation.h"
#include "light/world.h"
#include "passes/pipeline/pass.h"
#include "scenegraph/patches.h"

namespace wrlkit::bake {

struct FromPatchesOptions {
  bool smooth = false;  // colours between the corners of patches
  std::string extension = "png";
  Tessellation faces{.texcoords = true};
};

/// `world` is that of `scene`. Patches that lie on no surface are reported (orphan-patches). Geometry that several
/// Shapes show is copied. Both sides of a face of `solid` FALSE get faces where both can be seen (parts.h). Statistics:
/// lightmap.shapes, .patches, .orphans, and .bare-triangles, which have no patch and so the mean light of their Shape.
/// False when no patch has found its place.
bool light_from_patches(Scene& scene, const light::LightWorld& world, const PatchSet& patches,
                        const FromPatchesOptions& options, PassContext& ctx);

}  // namespace wrlkit::bake
