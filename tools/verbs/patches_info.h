// What is inside a patch file: `wrlkit info` of one.
#pragma once
#include <optional>
#include <string>

#include "base/io/read_file.h"
#include "tools/cli/session.h"

namespace wrlkit {

/// The text, or with --json the object; nothing when the file is none, which is reported.
std::optional<std::string> patches_info(Session& s, const FileText& file);

}  // namespace wrlkit
