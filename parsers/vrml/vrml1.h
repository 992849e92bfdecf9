// VRML 1.0 and Inventor ASCII text to a scene.
#pragma once
#include <cstdint>
#include <string_view>

#include "scenegraph/builder.h"

namespace wrlkit::vrml {

/// Reads VRML 1.0 text behind its header line into `scene`, as it says: the state of its traversal is the business of
/// the pass lower-vrml1. Faults, places and limits as in parser.h. Children of a node, which have no field in the text,
/// are in the field `children`. What a self-describing node declares (`fields [ ]`, `isA [ ]`) is in extra fields of
/// the declared types. Also of Inventor 2.x: its nodes, '~' and connections to engines, which are reported and not
/// kept. O(text).
void parse_vrml1(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag);

}  // namespace wrlkit::vrml
