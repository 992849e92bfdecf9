#include "passes/analysis/world_scales.h"

#include "geometry/simplify/surface_scales.h"
#include "passes/expand_protos/expand_protos.h"

namespace wrlkit {

std::vector<double> world_scales(const Scene& scene, std::span<const ShapeSurface> surfaces, Resources* files) {
  if (scene.proto_count() == 0) return largest_scales(scene, surfaces);
  Scene expanded = scene;
  Diagnostics unheard;
  Statistics uncounted;
  PassContext silent(unheard, uncounted, files);
  expand_protos(expanded, {}, silent);
  return largest_scales(scene, expanded, surfaces);
}

}  // namespace wrlkit
