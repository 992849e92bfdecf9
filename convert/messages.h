// Messages as values, with the place that they are about.
#pragma once
#include <string>
#include <vector>

#include "base/diagnostics.h"

namespace wrlkit {

struct MessageView {
  Severity severity;
  std::string name, text;    // name: see `wrlkit explain NAME`
  std::string file;          // empty: it is not about a place
  std::size_t line, column;  // from 1; 0: about the file as a whole

  /// "pump.wrl:12:5: warning: ... [unknown-field]"
  std::string str() const;
};

/// Those that were kept (Diagnostics::kept_per_name), in the order in which they were reported.
std::vector<MessageView> views(const Diagnostics& diag);

}  // namespace wrlkit
