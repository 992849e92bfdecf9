// What becomes of the nodes of X3D, by component, for docs/nodes.md.
#pragma once
#include <string>
#include <string_view>

#include "scenegraph/node_table.h"

namespace wrlkit {

/// In words; empty for what X3D does not have.
std::string_view node_fate(const NodeType&);
/// A table of Markdown: every node of X3D 4.0 once.
std::string node_fates_table();

}  // namespace wrlkit
