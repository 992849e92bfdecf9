#include "writers/gltf/document/sky.h"

#include <algorithm>

#include "base/math/affine.h"
#include "scenegraph/nodes.h"

namespace wrlkit::gltf {

std::span<const NodeId> sky_shapes(const Scene& scene, NodeId n) {
  if (scene.is(n, nodes::Background)) return scene.get(n, nodes::background::sky);
  if (scene.is(n, nodes::TextureBackground)) return scene.get(n, nodes::texture_background::sky);
  return {};
}

void place_sky(Document& d) {
  if (!d.sky) return;
  constexpr double room = 1.5, no_world = 100;
  const bool empty = d.world.empty();
  const Vec3 centre = empty ? Vec3{0, 0, 0} : d.world.centre();
  double reach = empty ? 0 : diagonal(d.world) / 2;
  for (const Camera& c : d.cameras) reach = std::max(reach, length(c.position - centre));
  d.sky->centre = centre;
  d.sky->radius = reach > 0 && std::isfinite(reach) ? room * reach : no_world;
  if (!is_invertible(d.sky->frame)) return;
  const double radius = d.sky->radius / mean_scale(d.sky->frame);
  const Vec3 here = inverse(d.sky->frame).point(centre);
  d.nodes[d.sky->node].transform = d.add_transform({here, {}, {radius, radius, radius}});
}

}  // namespace wrlkit::gltf
