// The Background as one picture.
#pragma once
#include "passes/pipeline/pass.h"

namespace wrlkit {

/// Equirectangular, 2048 x 1024 pixels, as PNG, by the bound Background of the world as `render` shows it: +Y is up,
/// the middle looks along +X, and +Z is a quarter to the right of it, as three.js maps such pictures. Null where the
/// world has no Background.
std::shared_ptr<const std::string> sky_panorama(const Scene&, PassContext&);

}  // namespace wrlkit
