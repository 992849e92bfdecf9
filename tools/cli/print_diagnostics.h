// Messages for people and for machines: text with an excerpt of the line, or JSON.
#pragma once
#include <string>

#include "base/diagnostics.h"

namespace wrlkit {

/// file:line:column: severity: text [name], the line and a caret; with colours for a terminal.
std::string message_text(const Message&, const Sources&, bool colours);
/// All messages, and how many more of each there were. `quiet`: only errors.
std::string messages_text(const Diagnostics&, bool colours, bool quiet);
/// A line for each kind of message, the first of it without its excerpt, and how many there are. `quiet`: only errors.
std::string messages_brief(const Diagnostics&, bool colours, bool quiet);
/// "1 error", "2 errors".
std::string counted(std::size_t n, std::string_view what);
/// [{"severity": ..., "name": ..., "text": ..., "file": ..., "line": ..., "column": ..., "count": ...}, ...]
std::string messages_json(const Diagnostics&);

}  // namespace wrlkit
