// Scripts that change what is seen while a browser loads a world: what the pass `startup` would run.
#pragma once
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "scenegraph/scene.h"

namespace wrlkit {

/// Fields that ROUTEs connect Scripts with a function `initialize` to: "Switch.whichChoice". In the file as it is, the
/// bodies of its prototypes included. Whether initialize() sends these events is known once it has run.
struct StartupScripts {
  std::size_t n_scripts = 0;
  std::vector<std::string> fields;  // each once, by name

  bool switches() const;
};
StartupScripts startup_scripts(const Scene& scene);

/// Reports them (scripts-not-run), unless there are none.
void report_startup_scripts(const Scene& scene, Diagnostics& diag);

}  // namespace wrlkit
