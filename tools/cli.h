#pragma once
#include "tools/flags.h"

namespace wrlkit {

/// Reads the words of a command line, runs the verb and returns the exit code.
int run_command_line(int argc, char** argv);

}  // namespace wrlkit
