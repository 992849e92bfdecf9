// A world as a VRML or X3D file, with the pictures that passes have made beside it.
#pragma once
#include <string>

#include "tools/cli/session.h"

namespace wrlkit {

/// The pipeline in front of a VRML file: "vrml"; with --dump or -p none the world stays as it is.
std::string_view vrml_pipeline(const Flags&);

/// As the flags want it, all files or none but for faults of the system in between; false, and a message, when not.
bool write_vrml_file(Session&, const Scene&, const std::string& path, bool gzip);
bool write_x3d_file(Session&, const Scene&, const std::string& path, bool gzip);

}  // namespace wrlkit
