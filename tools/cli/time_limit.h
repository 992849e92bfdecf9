// What takes too long is given up.
#pragma once

namespace wrlkit {

/// Ends the process with a message and exit code 3 when so much time has passed, in seconds. What is being written has
/// no name yet and goes with it (base/io/output.h). Once for a process.
void limit_time(double seconds);

}  // namespace wrlkit
