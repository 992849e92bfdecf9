// The command line. Which words it knows is in cli.cpp, what a verb does is in its own file.
#include <sys/resource.h>

#include <cstdio>
#include <exception>
#include <new>

#include "tools/cli.h"

int main(int argc, char** argv) {
  using namespace wrlkit;
  try {
    return run_command_line(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("wrlkit: error: there is not enough memory\n", stderr);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "wrlkit: error: %s\n", e.what());
  }
  return nothing;
}
