// Dark specks: what of a bake is looked for when it is judged.
#pragma once
#include <cstdint>

#include "passes/lightmap/page.h"

namespace wrlkit::bake {

/// Texels that show less than half of the light that those around them in their chart have, all but one, and by what is
/// seen: nothing in the world is so small that only they are in its shadow. O(texels).
std::uint64_t count_specks(const Page& page, const std::vector<Rgb>& light);

}  // namespace wrlkit::bake
