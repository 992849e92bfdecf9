#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <tuple>

#include "tools/cli/cli.h"
#include "tools/cli/end_now.h"

namespace wrlkit {
namespace {

/// A full disk shows when what was printed leaves the buffer, not before.
bool everything_printed() {
  const bool is_flushed = std::fflush(stdout) == 0;
  if (is_flushed && !std::ferror(stdout)) return true;
  const char* why = is_flushed ? "it is closed, or its disk is full" : std::strerror(errno);  // errno may be of later
  std::fprintf(stderr, "wrlkit: error: cannot write to standard output: %s\n", why);
  return false;
}

/// A file that is mapped was cut by another program (LoadOptions::map_files).
void file_was_cut(int) { end_now("wrlkit: error: the input was shortened while it was read\n"); }

/// A descriptor that the caller has closed would become that of the first file that is opened: what is printed would go
/// there, or nowhere without a word.
void open_standard_streams() {
  for (const auto& [stream, file, mode] : {std::tuple(STDIN_FILENO, "/dev/null", O_RDONLY),
                                           {STDOUT_FILENO, "/dev/full", O_WRONLY},
                                           {STDERR_FILENO, "/dev/null", O_WRONLY}})
    if (fcntl(stream, F_GETFD) == -1) open(file, mode);
}

}  // namespace

int run_program(int argc, char** argv) {
  open_standard_streams();
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
