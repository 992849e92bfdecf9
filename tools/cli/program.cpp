#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "tools/cli/cli.h"
#include "tools/cli/end_now.h"

namespace wrlkit {
namespace {

/// A full disk shows when what was printed leaves the buffer, not before.
bool everything_printed() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return true;
  std::fprintf(stderr, "wrlkit: error: cannot write to standard output: %s\n", std::strerror(errno));
  return false;
}

/// A file that is mapped was cut by another program (LoadOptions::map_files).
void file_was_cut(int) { end_now("wrlkit: error: the input was shortened while it was read\n"); }

}  // namespace

int run_program(int argc, char** argv) {
  std::signal(SIGBUS, file_was_cut);
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
