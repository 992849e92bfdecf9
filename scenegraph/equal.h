// Structural equality: what the round-trip tests mean by "the same scene".
#pragma once
#include <string>

#include "scenegraph/scene.h"

namespace wrlkit {

/// Empty when the scenes are equal: nodes, DEF names, values (a written default equals one left out), sharing by
/// USE, prototypes, ROUTEs between nodes of the scene, unknown nodes and fields, comment. Otherwise the first
/// difference, in words. Ids, places and the order of fields do not count. O(scene).
std::string difference(const Scene& a, const Scene& b);

/// Two values of one type hold the same; node references are compared by `same_node`.
bool equal_plain(const Value& a, const Value& b);
/// A value that says no more than the default of its field: of nodes, none at all.
bool equals_default(const Value& v, const FieldDef& f);

}  // namespace wrlkit
