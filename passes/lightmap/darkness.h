// Shapes that are black all over, of which whoever looks at the world wants to know why.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "passes/lightmap/layout.h"
#include "passes/lightmap/rgb.h"

namespace wrlkit::bake {

struct DarkUse {
  std::uint32_t use;  // into Stage::uses
  std::size_t n_texels;
};

/// The uses on a page of which a hundredth of the texels, at the most, is brighter than what 8 bits show as black; by
/// use. `charts`: of each texel, PlacedTriangle::chart or TexelPlace::nowhere. Linear.
std::vector<DarkUse> dark_uses(const PageLayout& page, std::span<const std::uint32_t> charts,
                               std::span<const Rgb> light);

}  // namespace wrlkit::bake
