#include "tools/cli/python_passes.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tools/cli/flags.h"

#ifndef WRLKIT_PYTHON
#define WRLKIT_PYTHON "python3"
#endif

namespace wrlkit {
namespace {

namespace fs = std::filesystem;

/// The folder with the package: next to the program in the build tree, installed in a folder of libraries. Empty: there
/// is none.
std::string package_folder() {
  std::error_code none;
  const auto self = fs::read_symlink("/proc/self/exe", none).parent_path(), lib = self / ".." / "lib";
  std::vector<fs::path> folders{self / "python", lib / "wrlkit" / "python"};
  for (fs::directory_iterator i(lib, none), end; !none && i != end; i.increment(none))
    folders.push_back(i->path() / "wrlkit" / "python");  // lib/x86_64-linux-gnu
  const auto found =
      std::ranges::find_if(folders, [&](const fs::path& f) { return fs::exists(f / "wrlkit" / "__main__.py", none); });
  return found == folders.end() ? "" : fs::canonical(*found, none).string();
}

/// Unless the user has said otherwise.
void set(const char* name, const char* value) { setenv(name, value, 0); }

}  // namespace

bool load_python_passes(const std::vector<std::string>& paths, std::string& why) {
  if (paths.empty()) return true;
  if (!load_python_file) throw NeedsPython{};
  return std::ranges::all_of(paths, [&](const std::string& path) { return load_python_file(path, why); });
}

int run_in_python(char** words) {
  const auto folder = package_folder();
  if (folder.empty()) {
    fmt::print(stderr,
               "wrlkit: passes in Python need the Python package, which is not installed next to this program\n");
    return usage;
  }
  const char* others = std::getenv("PYTHONPATH");
  setenv("PYTHONPATH", (others && *others ? folder + ":" + others : folder).c_str(), 1);
  set("PYTHONHASHSEED", "0");        // the same order of sets in every run
  set("OPENBLAS_NUM_THREADS", "1");  // the workers of a corpus run are forks, which have no other threads
  set("OMP_NUM_THREADS", "1");
  const char* python = std::getenv("WRLKIT_PYTHON");
  if (!python || !*python) python = WRLKIT_PYTHON;
  std::vector<char*> arguments;
  for (const char* word : {python, "-P", "-m", "wrlkit"}) arguments.push_back(const_cast<char*>(word));
  for (++words; *words; ++words) arguments.push_back(*words);
  arguments.push_back(nullptr);
  execvp(python, arguments.data());
  fmt::print(stderr, "wrlkit: passes in Python: '{}' cannot be run: {}\n", python, std::strerror(errno));
  return usage;
}

}  // namespace wrlkit
