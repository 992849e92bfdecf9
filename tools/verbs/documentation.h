// The tables as text: for the terminal, for JSON and for the generated pages of docs/.
#pragma once
#include <span>
#include <string>

#include "base/diagnostics.h"
#include "passes/pipeline/pipeline.h"
#include "scenegraph/browser_nodes.h"
#include "scenegraph/node_table.h"

namespace wrlkit {

std::string type_text(const NodeType&);
std::string browser_node_text(const BrowserNode&);
std::string pass_text(const PassInfo&);
std::string diagnostic_text(Diag);
std::string formats_text();
std::string passes_json();
std::string formats_json();

/// A page of docs/, NAME.md; script/docs writes them all, a test compares.
struct DocumentationPage {
  std::string_view name;
  std::string (*text)();
};
std::span<const DocumentationPage> documentation_pages();

}  // namespace wrlkit
