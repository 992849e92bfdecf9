// Coordinates far from their origin. Single precision has 24 bits, so a number of size c is wrong by up to c / 2^24: at
// the coordinates of a national grid, 5,000 km, by 0.3 m.
//
// A mesh gets an origin of its own, a translation of its node in double, when it is small against its distance: when it
// would lose more than 1e-4 of its extent, or when it would lose more than 1 mm and its coordinates are more than ten
// times its extent. A scene does so only by the second rule, because files that belong together should stay together.
#pragma once
#include <optional>

#include "writers/gltf/box.h"

namespace wrlkit::gltf {

/// Origin for what fills a box; none when its coordinates are good as they are. Its components are few binary digits,
/// so that subtracting it is exact, and its text short.
std::optional<Vec3> mesh_origin(const Box&);
std::optional<Vec3> world_origin(const Box&);

}  // namespace wrlkit::gltf
