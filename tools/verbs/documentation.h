// The tables as text: for the terminal and for the generated pages of docs/; documentation_json.h has them as JSON.
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

/// Words that all forms of the documentation share.
std::string_view level_word(Level);
/// Range, unit, kinds: what limits a value; and whether it is a field of wrlkit's own.
std::string limits_text(const FieldDef&);
/// What the field says, and in which dialect it is otherwise.
std::string doc_text(const NodeType&, const FieldDef&);
std::string_view fate_text(BrowserNode::Fate);

/// A page of docs/, NAME.md; script/docs writes them all, a test compares.
struct DocumentationPage {
  std::string_view name;
  std::string (*text)();
};
std::span<const DocumentationPage> documentation_pages();

}  // namespace wrlkit
