#include "tools/cli/end_now.h"

#include <unistd.h>

#include "tools/cli/flags.h"

namespace wrlkit {

void end_now(std::string_view line) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
  _exit(nothing);
}

}  // namespace wrlkit
