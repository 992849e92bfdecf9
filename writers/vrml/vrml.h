// A scene as VRML97 text.
#pragma once
#include <string>

#include "base/diagnostics.h"
#include "base/io/sink.h"
#include "scenegraph/scene.h"
#include "writers/text/options.h"

namespace wrlkit {

/// Canonical VRML97 (ISO/IEC 14772-1): fields in the order of the node table, values that equal their default left out,
/// prototypes first and ROUTEs last in their scope, numbers as short as they can be, UTF-8, LF. DEF names stay unless a
/// USE or ROUTE would mean another node then. What was read from VRML97 reads back as the same scene. O(scene).
void write_vrml(const Scene&, const TextOptions&, const Sink&, Diagnostics&);

}  // namespace wrlkit
