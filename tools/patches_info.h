// What is inside a patch file: `wrlkit info` of one.
#pragma once
#include "parsers/read_file.h"
#include "tools/session.h"

namespace wrlkit {

/// Prints it and gives the exit code.
int print_patches_info(Session& s, const FileText& file);

}  // namespace wrlkit
