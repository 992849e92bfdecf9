// The program of a Script: in its url, or in a file.
#pragma once
#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// A Script, with fields of its own or without.
bool is_script(const Scene&, NodeId);

/// Fields that every Script has; its own follow them.
std::size_t n_common_script_fields();

/// Whether it has a program in ECMAScript with a function `initialize`, as far as its own file says.
bool has_initialize(const Scene&, NodeId script);

/// Whether its program may be in a file .js: what that holds is not known.
bool is_script_in_file(const Scene&, NodeId);

/// The text of the first of its urls that is in ECMAScript or VRMLScript: "javascript:...", "ecmascript:...",
/// "vrmlscript:...", or a file whose name ends in .js. None when there is no such url, or its file cannot be read,
/// which is reported.
std::optional<std::string> script_text(const Scene&, NodeId script, Resources*, Diagnostics&);

}  // namespace wrlkit
