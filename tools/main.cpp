// The command line. The keywords it knows are in cli.cpp, what a verb does is in its own file.
#include "tools/cli/cli.h"
#include "tools/cli/python_passes.h"

int main(int argc, char** argv) {
  try {
    return wrlkit::run_program(argc, argv);
  } catch (const wrlkit::NeedsPython&) {
    return wrlkit::run_in_python(argv);
  }
}
