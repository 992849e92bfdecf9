// The steps of a conversion, as the command line and a run over a corpus take them.
#pragma once
#include <functional>

#include "convert/save.h"
#include "tools/cli/session.h"

namespace wrlkit {

/// What the flags say, with what --profile chooses where they do not.
SaveOptions save_options(const Flags&);
/// Prints which of the options that were given have no effect on this output.
void warn_of_idle_options(const Flags&);
/// Chooses the pipeline; false when a flag makes no sense, which was printed.
bool prepare_conversion(Session&);
/// Reads the input; false when there is nothing to convert.
bool read_input(Session&);
/// Writes what was read. `last` is given the scene of a text format before it is written.
Saved write_world(Session&, SaveOptions, const std::function<void(Scene&)>& last = {});

}  // namespace wrlkit
