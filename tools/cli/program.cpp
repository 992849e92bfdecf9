#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "tools/cli/cli.h"

namespace wrlkit {
namespace {

/// A full disk shows when what was printed leaves the buffer, not before.
bool everything_printed() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return true;
  std::fprintf(stderr, "wrlkit: error: cannot write to standard output: %s\n", std::strerror(errno));
  return false;
}

}  // namespace

int run_program(int argc, char** argv) {
  try {
    const int code = run_command_line(argc, argv);
    return everything_printed() ? code : nothing;
  } catch (const std::bad_alloc&) {
    std::fputs("wrlkit: error: there is not enough memory\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "wrlkit: error: %s\n", e.what());
  }
  return nothing;
}

}  // namespace wrlkit
