// What becomes of the nodes of X3D, by component, for docs/nodes.md.
#pragma once
#include <string>

namespace wrlkit {

/// A table of Markdown: every node of X3D 4.0 once.
std::string node_fates_table();

}  // namespace wrlkit
