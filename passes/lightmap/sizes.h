// Shapes share the places of their texels with their geometry. Where one shows it in another size, or is to have more
// texels, it needs places of its own.
#pragma once
#include <functional>
#include <vector>

#include "passes/lightmap/parts.h"

namespace wrlkit::bake {

/// Splits parts, so that all Shapes of one have the same `density(use)` and show the geometry in the same size along
/// all of its directions, within a seventh; turned and mirrored ones stay together. Those of the first Shape are first.
/// n log n in the Shapes.
void split_by_size(std::vector<Part>& parts, const drawing::Stage& stage,
                   const std::function<double(std::uint32_t use)>& density);

}  // namespace wrlkit::bake
