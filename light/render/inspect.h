// Pictures for who judges a lightmap: the light alone, its texels as a checkerboard, how many of them a metre has, and
// the colours of surfaces without any light.
#pragma once
#include "light/render/camera.h"
#include "light/render/render.h"
#include "light/render/shade.h"
#include "light/render/tracer.h"

namespace wrlkit::drawing {

class Inspector {
 public:
  Inspector(const Drawing& drawing, const Tracer& tracer, const Camera& camera, RenderOptions::Mode mode,
            const V3& background)
      : drawing_(drawing), tracer_(tracer), camera_(camera), mode_(mode), background_(background) {}

  /// The colour of a place in the picture, each component in [0, 1].
  V3 color(double px, double py) const;

 private:
  V3 albedo(const Hit& hit, double area, double facing) const;
  V3 light(const Hit& hit, double area, double facing) const;

  const Drawing& drawing_;
  const Tracer& tracer_;
  const Camera& camera_;
  RenderOptions::Mode mode_;
  V3 background_;
};

}  // namespace wrlkit::drawing
