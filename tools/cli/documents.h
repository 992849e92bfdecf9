// What --json has on standard output: one document for each run of the program, also where no scene was read.
#pragma once
#include <string_view>

#include "tools/cli/flags.h"

namespace wrlkit {

/// Prints a document, and a line break.
void print_document(std::string_view json);

/// What --json prints, and --report writes to a file, of verbs that give both the same. False when the file cannot be
/// written, which was printed.
bool give_document(const Flags&, std::string_view json);

/// Prints why inputs cannot be used, as a line on standard error, and keeps it for the document.
void complain(std::string_view verb, std::string_view why);

/// With --json, a document of what complain() was given, unless there has been one.
void print_failure(const Flags&, int code);

}  // namespace wrlkit
