// What parsers repair in files, in scenes that programs have made.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Whether a value can be written as it is.
bool can_be_written(const Value&);
/// What repair_values says of one that cannot.
void report_repair(const Scene&, NodeId, const Value&, Diagnostics&);

/// Makes a scene one that can be written and read again: numbers that are not finite become 0, NULL in lists of nodes
/// is dropped, text that is not UTF-8 is taken for ISO 8859-1, images end with their last pixel, ROUTEs of events that
/// are no names are dropped, and comment lines begin with '#'. All but the last is reported. What `verify` finds is not
/// repaired. O(scene).
void repair_values(Scene&, Diagnostics&);

}  // namespace wrlkit
