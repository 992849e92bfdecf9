// The tables as JSON, for --json of passes, formats, explain and docs. The keys are stable.
#pragma once
#include <string>

#include "tools/verbs/documentation.h"

namespace wrlkit {

/// All passes, those written in Python at the end.
std::string passes_json();
std::string pass_json(const PassInfo&);
std::string formats_json();

/// What `explain` says: an object whose "kind" is node, browser-node, pass or message.
/// `types`: the node types of one name, one for each language in which it means something else.
std::string explained_nodes_json(std::span<const NodeType* const> types);
std::string explained_json(const BrowserNode&);
std::string explained_json(const PassInfo&);
std::string explained_json(Diag);

/// The names of the pages.
std::string pages_json();
/// A page: its name, and its text in Markdown.
std::string page_json(const DocumentationPage&);

}  // namespace wrlkit
