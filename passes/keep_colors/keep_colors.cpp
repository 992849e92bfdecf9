#include "passes/keep_colors/keep_colors.h"

#include "passes/lower_x3d/product.h"
#include "scenegraph/x3d_version.h"

namespace wrlkit {

Outcome keep_colors(Scene& scene, const KeepColorsOptions&, PassContext& ctx) {
  return x3d_version(scene) >= 40 && x3d::whiten_replaced(scene, ctx) ? Outcome::changed : Outcome::unchanged;
}

}  // namespace wrlkit
