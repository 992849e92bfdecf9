// A conversion, for the verb and for those who convert many files.
#pragma once
#include "tools/session.h"

namespace wrlkit {

/// Chooses the pipeline by the flags and the name of the output; false when that cannot be done, which was printed.
bool prepare_conversion(Session&);
/// Reads the input, runs the pipeline and writes the output; false when there is none. Messages are in the session.
bool convert_world(Session&);

}  // namespace wrlkit
