// wrlkit view of a tileset: a page that loads it.
#pragma once
#include <span>
#include <string>

#include "tools/cli/session.h"

namespace wrlkit {

/// The folder of the tileset when the only input is one: a folder with a tileset.json, or that file. Empty otherwise.
std::string tileset_folder(std::span<const std::string> inputs);

/// Writes the page of a tileset to -o, or shows it with --serve, and nothing else than what lies in its folder. The
/// exit code.
int view_tileset(Session& session, const std::string& folder);

}  // namespace wrlkit
