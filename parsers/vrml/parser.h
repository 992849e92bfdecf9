// VRML97 text to a scene.
#pragma once
#include <cstdint>
#include <functional>
#include <string_view>

#include "scenegraph/builder.h"

namespace wrlkit::vrml {

/// Told of a part of the text that is not looked at for some time. It may be called on several threads.
using PartRead = std::function<void(std::string_view)>;

/// Reads VRML97 text behind its header line into `scene`, as far as it can be read: after a fault it goes on at the
/// matching brace, so that the nodes before, after and around it survive; every fault and every repair is reported.
/// `base` is the offset of text[0] in diag.sources(). O(text), one pass; recursion is bounded by limits.depth.
/// Grammar: ISO/IEC 14772-1, annex A. Large texts are read on several threads, with the same result.
void parse(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene, Diagnostics& diag,
           const PartRead& part_read = {});

/// What `parse` does first with large texts, of whatever size this one is. False, and nothing has happened, when the
/// text has a list of numbers that is not written plainly (deferred_lists.h).
bool parse_on_threads(std::string_view text, std::uint32_t base, const ParseLimits& limits, Scene& scene,
                      Diagnostics& diag, const PartRead& part_read = {});

}  // namespace wrlkit::vrml
