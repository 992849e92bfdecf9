// Checks of a whole scene against the node table and against what a level promises.
#pragma once
#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Levels of a scene. authored: as the file says. expanded: no PROTO instance and no Inline that could be loaded. mesh:
/// every geometry is IndexedFaceSet, IndexedLineSet or PointSet, but what is driven (driven.h). A pass names the level
/// it needs and the one it leaves.
enum class Level : std::uint8_t { authored, expanded, mesh };

/// What `check` reports in addition to the parser: values out of range, unknown keywords, nodes in places that cannot
/// hold them, wrong ROUTE types; and of scenes that programs make, what repair_values repairs. Warnings only: such
/// files are read all the same. O(scene).
void check_values(const Scene&, Diagnostics&);
/// The same of one value that a node has, or is to have.
void check_value(const Scene&, NodeId, const Value&, Diagnostics&);

/// Invariants of a level; each breach is an error `verify`. True when there was none. O(n log n) in the fields.
///
/// In every scene: types, children, roots, ROUTEs, IMPORTs, EXPORTs and prototypes that exist; values of the type of
/// their field, one for each, in the order of the slots where there are many; no node below itself, but by way of a
/// Script or an instance. Whether children are of the kind that a field wants is for check_values: files may be wrong.
bool verify(const Scene&, Level, Diagnostics&);

}  // namespace wrlkit
