// A scene as X3D in its XML encoding.
#pragma once
#include <string>

#include "base/diagnostics.h"
#include "base/io/sink.h"
#include "scenegraph/scene.h"
#include "writers/text/options.h"

namespace wrlkit {

/// X3D 4.0 (ISO/IEC 19775-1 and 19776-1): the smallest of the profiles Interchange and Immersive that has the nodes,
/// with the components and levels that they need beyond it; fields in the order of the node table, those that say what
/// the default says left out. What was read reads back as the same scene, but for unknown fields whose names are no
/// names of XML (no-x3d-value). O(scene).
void write_x3d(const Scene&, const TextOptions&, const Sink&, Diagnostics&);

}  // namespace wrlkit
