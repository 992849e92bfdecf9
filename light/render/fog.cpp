#include "light/render/fog.h"

#include "scenegraph/nodes.h"

namespace wrlkit::drawing {

Fog::Fog(const Scene& scene, const Placed& p, const Stage& stage) {
  namespace f = nodes::fog;
  color_ = scene.get(p.node, f::color);
  exponential_ = scene.get(p.node, f::fogType) == "EXPONENTIAL";
  to_local_ = stage.frames[p.frame].inverse();
  if (finite(to_local_)) range_ = scene.get(p.node, f::visibilityRange);
}

double Fog::clarity(double distance) const {
  if (!(distance < range_)) return 0;
  return exponential_ ? std::exp(-distance / (range_ - distance)) : (range_ - distance) / range_;
}

}  // namespace wrlkit::drawing
