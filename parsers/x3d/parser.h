// X3D in its XML encoding (ISO/IEC 19776-1) to a scene.
#pragma once
#include <cstdint>
#include <string_view>

#include "scenegraph/builder.h"

namespace wrlkit::x3d {

/// Reads an X3D document into `scene`, as far as it can be read: of a text that is cut off or not well-formed what
/// stands before the fault. `base` is the offset of text[0] in diag.sources(); messages point into the values of
/// attributes. Elements that are not a node of X3D become nodes of unknown type. O(text); recursion is bounded by
/// limits.depth.
void parse(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag);

/// "3.3" as 33; 33 for what is not a version.
int version_number(std::string_view);

}  // namespace wrlkit::x3d
