// VRML97 text to a scene.
#pragma once
#include <cstdint>
#include <string_view>

#include "scenegraph/builder.h"

namespace wrlkit::vrml {

/// Reads VRML97 text behind its header line into `scene`, as far as it can be read: after a fault it goes on at the
/// matching brace, so that the nodes before, after and around it survive; every fault and every repair is reported.
/// `base` is the offset of text[0] in diag.sources(). O(text), one pass; recursion is bounded by limits.depth.
/// Grammar: ISO/IEC 14772-1, annex A.
void parse(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag);

}  // namespace wrlkit::vrml
