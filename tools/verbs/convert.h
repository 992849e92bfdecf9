// A conversion, for the verb and for those who convert many files.
#pragma once
#include <functional>

#include "tools/cli/session.h"

namespace wrlkit {

/// Whether the end of a name says in which format a world is written there.
bool is_output_name(const std::string& name);
/// Chooses the pipeline by the flags and the name of the output; false when that cannot be done, which was printed.
bool prepare_conversion(Session&);
/// Reads the input, runs the pipeline and writes the output; false when there is none. Messages are in the session.
bool convert_world(Session&);

/// The two halves of that: reads the input; runs the pipeline and writes the output. `last` sees the scene as it is
/// written, as VRML or X3D.
bool read_input(Session&);
bool write_world(Session&, const std::function<void(Scene&)>& last = {});

}  // namespace wrlkit
