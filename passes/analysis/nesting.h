// Passes that put nodes together can nest them deeper than any file may, or put a node into itself. Writers and later
// passes rely on neither.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Takes children out of nodes that are in themselves (a Script or an instance may hold a node that it is in: 4.12.8)
/// and of such that have more than a thousand nodes below each other, and reports it. Linear.
void limit_nesting(Scene&, Diagnostics&);

}  // namespace wrlkit
