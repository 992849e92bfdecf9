// Charts that lie within something altogether, where it is dark. Nobody sees them; but levels of detail that are made
// of this world later keep their light, and may show them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "passes/lightmap/page.h"

namespace wrlkit::bake {

/// Those of which no texel is known, and so black, take the mean light of their Shape's chart whose middle is nearest;
/// all are known then. A Shape none of whose charts has light stays dark: it may be a closed room. `chart`: of each
/// texel, TexelPlace::nowhere for none. `use_of`: by chart. O(texels + charts log charts).
void light_hidden_charts(const Page& page, std::span<const std::uint32_t> chart, std::span<const std::uint32_t> use_of,
                         std::vector<char>& known, std::vector<Rgb>& light);

}  // namespace wrlkit::bake
