// The steps of a conversion, as the command line and a run over a corpus take them.
#pragma once
#include <functional>
#include <string>

#include "convert/save.h"
#include "tools/cli/session.h"

namespace wrlkit {

/// What the flags say, with what --profile chooses where they do not.
SaveOptions save_options(const Flags&);
/// Prints which of the options that were given have no effect on this output.
void warn_of_idle_options(const Flags&);
/// Prints which files text on standard output refers to, unless it goes to a terminal: urls lead on from the input.
void warn_of_files_outside(Session&, const Output&, const SaveOptions&);
/// What --json prints of a conversion.
std::string facts_json(Session&, const Output&, const Saved&);
/// Chooses the pipeline; false when a flag makes no sense, which was printed.
bool prepare_conversion(Session&);
/// Reads the input; false when there is nothing to convert.
bool read_input(Session&);
/// Writes what was read. `last` is given the scene of a text format before it is written.
Saved write_world(Session&, SaveOptions, const std::function<void(Scene&)>& last = {});

}  // namespace wrlkit
