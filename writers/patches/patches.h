// Patch files (scenegraph/patches.h): what `wrlkit illuminate` writes.
#pragma once
#include "base/io/sink.h"
#include "scenegraph/patches.h"

namespace wrlkit {

/// Writes version 1, in metres. Coordinates have twelve digits and radiances six, so that the text of a set that was
/// read from such a file is that file again. The text is streamed: no memory beyond the set.
void write_patches(const PatchSet& set, const Sink& sink);

}  // namespace wrlkit
