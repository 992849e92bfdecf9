// Wireframe: grey surfaces, lit from the eye, with the edges of their triangles drawn in; what is behind is hidden.
#pragma once
#include "light/render/shade.h"

namespace wrlkit::drawing {

class Wireframe {
 public:
  Wireframe(const Drawing& drawing, const Tracer& tracer, const Camera& camera, const V3& background)
      : drawing_(drawing), tracer_(tracer), camera_(camera), background_(background) {}

  /// The colour of a place in the picture.
  V3 color(double px, double py) const;

 private:
  double ink(const Hit& hit, double px, double py) const;

  const Drawing& drawing_;
  const Tracer& tracer_;
  const Camera& camera_;
  V3 background_;
};

}  // namespace wrlkit::drawing
