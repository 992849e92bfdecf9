// The light of a whole scene as patches: what RenderX did for Lazanyi (3.1), and what `wrlkit illuminate` does.
#pragma once
#include "light/patches/methods.h"
#include "scenegraph/patches.h"

namespace wrlkit::light {

struct IlluminateOptions {
  Method method = Method::path;
  PatchSizes sizes;
  /// Patches are halved where the radiance of neighbours differs by more than this share of the mean of the world, down
  /// to an eighth of the largest edge; 0: they are not.
  double gradient = 0;
  MethodOptions how;
};

/// Radiance of each patch of each Shape that is shown, in the order of LightWorld::stage(); shapes have its numbers.
/// The same set for any number of threads. Memory: some 260 bytes a patch.
PatchSet illuminate(const Scene& scene, const LightWorld& world, const IlluminateOptions& options, Diagnostics& diag);

}  // namespace wrlkit::light
