// Light differs from place to place, so each place where a Shape is shown needs a Shape of its own. What is large stays
// shared: the geometry.
//
//   before   DEF Bolt Transform { children DEF S Shape { ... geometry DEF G ... } }   Transform { children USE Bolt }
//   after    DEF Bolt Transform { children DEF S Shape { ... geometry DEF G ... } }
//            Transform { children DEF Bolt_2 Transform { children DEF S_2 Shape { ... geometry USE G } } }
#pragma once
#include <cstdint>

#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit::bake {

/// Whether places below the further levels of a LOD count.
enum class OfLod : std::uint8_t { first, all };

/// Copies the grouping nodes and Shapes that the transformation hierarchy shows more than once (walk.h,
/// shown_children). Names of copies are made unique. Nodes that events can reach, and those that hold such a node, are
/// not copied: a copy would no longer move. Returns the number of copies; no more than `most` are made, which is
/// reported (expansion-limit). O(nodes and copies).
std::size_t own_shapes(Scene& scene, Diagnostics& diag, OfLod of_lod = OfLod::first, std::size_t most = 1'000'000);

}  // namespace wrlkit::bake
