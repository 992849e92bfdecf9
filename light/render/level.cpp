#include "light/render/level.h"

#include <algorithm>

#include "scenegraph/nodes.h"

namespace wrlkit::drawing {

LevelOf levels_by_distance(const Scene& scene, const V3& eye) {
  return [&scene, eye](NodeId lod, const Affine& frame) -> std::size_t {
    const V3 local = frame.inverse().point(eye);
    if (!finite(local)) return 0;
    const double distance = length(local - V3(scene.get(lod, nodes::lod::center)));
    const auto range = scene.get(lod, nodes::lod::range);
    return static_cast<std::size_t>(std::ranges::find_if(range, [&](double r) { return distance < r; }) -
                                    range.begin());
  };
}

}  // namespace wrlkit::drawing
