// What render does with more than one scene.
#pragma once
#include <string>

#include "tools/cli/session.h"
#include "tools/verbs/render_options.h"

namespace wrlkit {

/// Reads a scene, in place of the one before, and runs the pipeline; null when nothing can be read.
MeshSource open_world(Session&, const std::string& input);
/// A picture of the world that is open; --mode path says how far it is, as `name`. `diag`: where messages go, if not to
/// the session's.
Image draw(Session&, const MeshSource&, RenderOptions, std::string name, Diagnostics* diag = nullptr);
/// In the format of its name; false when not, which is reported. `is_derived`: nobody has chosen the name, so a file of
/// other contents that it replaces is reported.
bool write_picture(Session&, const Image&, const std::string& name, bool is_derived = false);

/// The inputs are several scenes.
bool is_sheet(const Flags&);
/// A picture of each, with its name. What cannot be read has its place, too. Returns the exit code.
int render_sheet(Session&);

/// Both scenes of --compare and the difference of their pictures.
bool render_comparison(Session&);

}  // namespace wrlkit
