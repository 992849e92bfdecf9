// The tables as text: for the terminal, for JSON and for the generated pages of docs/.
#pragma once
#include <string>

#include "base/diagnostics.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/node_table.h"

namespace wrlkit {

std::string type_text(const NodeType&);
std::string pass_text(const PassInfo&);
std::string diagnostic_text(Diag);
std::string formats_text();
std::string passes_json();
std::string formats_json();

// docs/nodes.md, docs/passes.md, docs/diagnostics.md; `wrlkit docs DIR` writes them, a test compares.
std::string nodes_page();
std::string passes_page();
std::string diagnostics_page();

}  // namespace wrlkit
