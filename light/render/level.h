// Which level of a LOD a viewer sees (ISO/IEC 14772-1, 6.26).
#pragma once
#include "light/render/stage.h"

namespace wrlkit::drawing {

/// By the distance of the eye to `center`, in the coordinates of the LOD: level i up to range[i], the one behind the
/// last range beyond it. Levels behind that one are ignored. Without ranges, which leave it to the browser, the first.
LevelOf levels_by_distance(const Scene& scene, const V3& eye);

}  // namespace wrlkit::drawing
