// How much of a thing is seen through the fog: Fog (ISO/IEC 14772-1, 6.19, 4.14.4).
#pragma once
#include "light/render/stage.h"

namespace wrlkit::drawing {

class Fog {
 public:
  /// No fog.
  Fog() = default;
  Fog(const Scene& scene, const Placed& node, const Stage& stage);

  /// A colour that lies `way` (world) from the eye, as it arrives there.
  V3 dim(const V3& color, const V3& way) const {
    return range_ > 0 ? mix(color_, color, clarity(length(to_local_.vector(way)))) : color;
  }

 private:
  /// f0 of 4.14.4, from 1 at the eye to 0 at the visibility range.
  double clarity(double distance) const;

  V3 color_{1};
  bool exponential_ = false;
  double range_ = 0;  // 0: no fog
  Affine to_local_;   // distances are measured in the frame of the Fog
};

}  // namespace wrlkit::drawing
