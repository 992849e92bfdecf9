// How a signal ends the program.
#pragma once
#include <string_view>

namespace wrlkit {

/// Writes the line to the error output and ends the process with exit code 3. For handlers of signals: it allocates
/// nothing and calls no destructor. What was being written has no name yet and goes with the process
/// (base/io/output.h).
[[noreturn]] void end_now(std::string_view line);

}  // namespace wrlkit
