// What `wrlkit info --json` prints, for the verb and for Python.
#pragma once
#include <string>

#include "convert/info.h"

namespace wrlkit {

/// One object without a line end. The keys are stable.
std::string info_json(const std::string& file, const Info&, const Diagnostics&);

}  // namespace wrlkit
