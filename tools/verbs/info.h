// What is inside a world, for the verb and for Python.
#pragma once
#include <optional>
#include <string>

#include "tools/cli/session.h"

namespace wrlkit {

/// What `wrlkit info` prints of the session's world, with --json as one object; the world is expanded by it. Nothing
/// when a pass fails.
std::optional<std::string> info_of(Session&);

}  // namespace wrlkit
