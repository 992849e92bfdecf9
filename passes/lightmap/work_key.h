// Which bake a checkpoint belongs to.
#pragma once
#include <cstdint>

#include "passes/lightmap/bake.h"

namespace wrlkit::bake {

/// Of all that the light of a tile depends on: the places of texels, geometry, what surfaces reflect, let through and
/// emit, lights, the sky and how much work is done. Colours are asked for at some thousand places of each Shape, the
/// sky's in some hundred directions. O(triangles).
std::uint64_t work_key(const std::vector<Part>& parts, const Layout& layout, const light::LightWorld& world,
                       const BakeOptions& options);

}  // namespace wrlkit::bake
