// What is inside a patch file: `wrlkit info` of one.
#pragma once
#include "base/io/read_file.h"
#include "tools/cli/session.h"

namespace wrlkit {

/// Prints it and gives the exit code.
int print_patches_info(Session& s, const FileText& file);

}  // namespace wrlkit
